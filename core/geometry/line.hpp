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

/// A line with the covariance of its direction alpha and its offset (towards the normal) at one
/// point of it, 2x2 [rad^2, rad m; rad m, m^2]. In the middle of the wall that was seen the two are
/// Gaussian for short and far walls as well; about another point the same holds to first order.
struct LineEstimate {
  Line line;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  /// [m] coordinate of that point along the line, from the foot of the perpendicular. There the
  /// offset is r, to first order.
  double along = 0.0;

  /// Variance [m^2] of the offset of the line where the coordinate along it is `t` [m].
  [[nodiscard]] double offset_variance(double t) const {
    const double s = t - along;
    return covariance(1, 1) - 2.0 * s * covariance(0, 1) + s * s * covariance(0, 0);
  }

  /// The covariance about another point of the line.
  [[nodiscard]] LineEstimate about(double t) const {
    LineEstimate result{line, covariance, t};
    result.covariance(0, 1) -= (t - along) * covariance(0, 0);
    result.covariance(1, 0) = result.covariance(0, 1);
    result.covariance(1, 1) = offset_variance(t);
    return result;
  }

  /// Variance [m^2] that the square of the error of the direction adds to r: r is m . n(alpha) for
  /// any point m of the line, and loses r / 2 times that square. It is the mean of its square.
  [[nodiscard]] double second_order_variance() const {
    const double variance = line.r * covariance(0, 0);
    return 0.75 * variance * variance;
  }

  /// Covariance of (alpha, r), the second order counted.
  [[nodiscard]] Eigen::Matrix2d alpha_r_covariance() const {
    Eigen::Matrix2d result = about(0.0).covariance;
    result(1, 1) += second_order_variance();
    return result;
  }

  /// Whether (alpha, r) is near enough to a Gaussian that the 95 % ellipse of its covariance holds
  /// 94 % and more. For a given alpha, r is a parabola of it with a spread; the probability of that
  /// depends on one number, the variance of the parabola over that of the spread, and falls to 94 %
  /// at this ratio.
  [[nodiscard]] bool is_gaussian_in_alpha_r() const {
    constexpr double largest_ratio = 0.38;
    const double determinant =
        covariance(0, 0) * covariance(1, 1) - covariance(0, 1) * covariance(1, 0);
    return second_order_variance() * covariance(0, 0) <= largest_ratio * determinant;
  }
};

/// The same line with r >= 0 and alpha in (-pi, pi]; the covariance changes sign with r where it
/// must.
[[nodiscard]] inline LineEstimate normalized(const LineEstimate& estimate) {
  LineEstimate result = estimate;
  if (result.line.r < 0.0) {
    // (alpha + pi, -r) is the same line; d(-r) = -dr turns the sign of the mixed term.
    result.line.r = -result.line.r;
    result.line.alpha += pi;
    result.along = -result.along;
    result.covariance(0, 1) = -result.covariance(0, 1);
    result.covariance(1, 0) = -result.covariance(1, 0);
  }
  result.line.alpha = normalized_angle(result.line.alpha);
  return result;
}

/// A fitted line with the ends of the wall that was seen, between which the covariance is about the
/// mid-point.
struct LineSegment {
  LineEstimate estimate;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< [m] projection of the first point
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< [m] projection of the last point
  std::size_t points = 0;                           ///< fitted; 0 when unknown
};

}  // namespace quoin
