// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/line.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"

namespace quoin {

Eigen::Vector2d Line::normal() const { return {std::cos(alpha), std::sin(alpha)}; }

LineEstimate normalized(const LineEstimate& estimate) {
  LineEstimate result = estimate;
  if (result.line.r < 0.0) {
    // (alpha + pi, -r) is the same line; d(-r) = -dr turns the sign of the mixed term.
    result.line.r = -result.line.r;
    result.line.alpha += pi;
    result.covariance(0, 1) = -result.covariance(0, 1);
    result.covariance(1, 0) = -result.covariance(1, 0);
  }
  result.line.alpha = normalized_angle(result.line.alpha);
  return result;
}

}  // namespace quoin
