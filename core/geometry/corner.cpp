// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/corner.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace quoin {

namespace {

/// Sine of the angle from one unit vector to the other.
double cross(const Eigen::Vector2d& first, const Eigen::Vector2d& second) {
  return first.x() * second.y() - first.y() * second.x();
}

}  // namespace

std::optional<Eigen::Vector2d> intersection(const Line& first, const Eigen::Vector2d& first_normal,
                                            const Line& second,
                                            const Eigen::Vector2d& second_normal) {
  constexpr double parallel = 1e-12;  // sine of the angle; below it the position is rounding only
  const double sine = cross(first_normal, second_normal);
  if (!(std::abs(sine) > parallel)) return std::nullopt;

  // WCTLS eq. (24), (25) with (a, b, c) = (cos alpha, sin alpha, -r).
  const double scale = 1.0 / sine;
  const Eigen::Vector2d position(
      (first.r * second_normal.y() - second.r * first_normal.y()) * scale,
      (second.r * first_normal.x() - first.r * second_normal.x()) * scale);
  if (!position.allFinite()) return std::nullopt;
  return position;
}

Eigen::Matrix2d intersection_covariance(const Eigen::Vector2d& position, const LineEstimate& first,
                                        const Eigen::Vector2d& first_normal,
                                        const LineEstimate& second,
                                        const Eigen::Vector2d& second_normal) {
  const double c1 = first_normal.x();
  const double s1 = first_normal.y();
  const double c2 = second_normal.x();
  const double s2 = second_normal.y();
  const double sine = cross(first_normal, second_normal);

  // Only the offset of each line at the corner moves the corner. With the normals as they were
  // estimated the true corner p fulfils n . (p - position) = offset exactly, so that errors of the
  // directions count to the second order as well, wherever on the lines the corner is.
  const double v1 = first.offset_variance(position.y() * c1 - position.x() * s1);
  const double v2 = second.offset_variance(position.y() * c2 - position.x() * s2);
  const double scale = 1.0 / (sine * sine);

  Eigen::Matrix2d covariance;
  covariance(0, 0) = (s2 * s2 * v1 + s1 * s1 * v2) * scale;
  covariance(0, 1) = -(s2 * c2 * v1 + s1 * c1 * v2) * scale;
  covariance(1, 0) = covariance(0, 1);
  covariance(1, 1) = (c2 * c2 * v1 + c1 * c1 * v2) * scale;
  return covariance;
}

std::optional<CornerEstimate> intersect(const LineEstimate& first, const LineEstimate& second) {
  return intersect(first, first.line.normal(), second, second.line.normal());
}

std::optional<CornerEstimate> intersect(const LineEstimate& first,
                                        const Eigen::Vector2d& first_normal,
                                        const LineEstimate& second,
                                        const Eigen::Vector2d& second_normal) {
  const auto position = intersection(first.line, first_normal, second.line, second_normal);
  if (!position) return std::nullopt;
  const CornerEstimate corner{
      *position, intersection_covariance(*position, first, first_normal, second, second_normal)};
  if (!corner.covariance.allFinite()) return std::nullopt;
  return corner;
}

CornerEstimate with_range_bias(const CornerEstimate& corner, double range_bias_stddev) {
  CornerEstimate result = corner;
  const double distance_squared = corner.position.squaredNorm();
  if (distance_squared > 0.0) {
    result.covariance += (range_bias_stddev * range_bias_stddev / distance_squared) *
                         (corner.position * corner.position.transpose());
  }
  return result;
}

Ellipse ellipse(const Eigen::Matrix2d& covariance, double mahalanobis_squared) {
  const double xx = covariance(0, 0);
  const double xy = covariance(0, 1);
  const double yy = covariance(1, 1);
  const double mean = 0.5 * (xx + yy);
  const double radius = std::hypot(0.5 * (xx - yy), xy);
  const double major = mean + radius;
  // det / major keeps the digits that mean - radius would lose for a slender ellipse.
  const double minor = major > 0.0 ? (xx * yy - xy * xy) / major : 0.0;
  Ellipse result;
  result.semi_major = std::sqrt(std::max(0.0, major * mahalanobis_squared));
  result.semi_minor = std::sqrt(std::max(0.0, minor * mahalanobis_squared));
  const double direction = 0.5 * std::atan2(2.0 * xy, xx - yy);
  result.direction = direction <= -0.5 * pi ? 0.5 * pi : direction;
  return result;
}

double one_sigma_ellipse_area(const Eigen::Matrix2d& covariance) {
  const double determinant =
      covariance(0, 0) * covariance(1, 1) - covariance(0, 1) * covariance(1, 0);
  return pi * std::sqrt(std::max(0.0, determinant));
}

}  // namespace quoin
