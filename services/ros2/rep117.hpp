// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace quoin::ros2 {

/// A range [m] as REP-117 writes it: +inf where nothing came back or it is beyond the limit, -inf
/// where something was too close, NaN for 0 and what is no range.
[[nodiscard]] inline float rep117_range(float range, float range_min, float range_max) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (range > range_max) return infinity;
  if (range >= range_min && range > 0.0F) return range;
  if (range > 0.0F || range == -infinity) return -infinity;
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace quoin::ros2
