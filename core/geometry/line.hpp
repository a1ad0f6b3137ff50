// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "core/geometry/angle.hpp"

namespace quoin {

/// Line in Hessian normal form, x cos(alpha) + y sin(alpha) = r.
struct Line {
  double alpha = 0.0;  ///< [rad] direction of the normal, in (-pi, pi]
  double r = 0.0;      ///< [m] distance from the sensor, >= 0

  /// Unit vector (cos(alpha), sin(alpha)), from the sensor towards the line.
  [[nodiscard]] Eigen::Vector2d normal() const { return {std::cos(alpha), std::sin(alpha)}; }
};

/// The same line by its unit normal, normal_x x + normal_y y = offset, for loops over points: they
/// need no angle. The offset may be negative.
struct NormalLine {
  double normal_x = 1.0;
  double normal_y = 0.0;
  double offset = 0.0;  ///< [m]

  /// Signed [m], of the point (x, y) [m].
  [[nodiscard]] double distance(double x, double y) const {
    return normal_x * x + normal_y * y - offset;
  }

  /// Coordinate along the line of the point (x, y) [m], from the foot of the perpendicular.
  [[nodiscard]] double along(double x, double y) const { return normal_x * y - normal_y * x; }

  [[nodiscard]] Line normal_form() const {
    return offset < 0.0 ? Line{direction_of(-normal_x, -normal_y), -offset}
                        : Line{direction_of(normal_x, normal_y), offset};
  }
};

/// A line with the covariance of (alpha, r), 2x2 [rad^2, rad m; rad m, m^2].
struct LineEstimate {
  Line line;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// The same line with r >= 0 and alpha in (-pi, pi]; the covariance changes sign with r where it
/// must.
[[nodiscard]] inline LineEstimate normalized(const LineEstimate& estimate) {
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

/// A fitted line with the ends of the wall that was seen.
struct LineSegment {
  LineEstimate estimate;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< [m] projection of the first point
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< [m] projection of the last point
  std::size_t points = 0;                           ///< fitted; 0 when unknown
};

}  // namespace quoin
