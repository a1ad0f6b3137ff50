// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace quoin {

inline constexpr double pi = std::numbers::pi;

/// The same direction in (-pi, pi] [rad].
[[nodiscard]] inline double normalized_angle(double angle) {
  const double reduced = std::remainder(angle, 2.0 * pi);  // in [-pi, pi]
  return reduced <= -pi ? pi : reduced;
}

/// Direction of the vector (x, y) in (-pi, pi] [rad].
[[nodiscard]] inline double direction_of(double x, double y) {
  const double angle = std::atan2(y, x);
  return angle <= -pi ? pi : angle;
}

}  // namespace quoin
