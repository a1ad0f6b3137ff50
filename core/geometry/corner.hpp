// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/geometry/line.hpp"

namespace quoin {

/// A point with its 2x2 covariance [m, m^2].
struct CornerEstimate {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// Where two lines meet, from their unit normals (cos alpha, sin alpha) too. Nothing when they are
/// parallel to rounding.
[[nodiscard]] std::optional<Eigen::Vector2d> intersection(const Line& first,
                                                          const Eigen::Vector2d& first_normal,
                                                          const Line& second,
                                                          const Eigen::Vector2d& second_normal);

/// Covariance of the `position` where two lines with independent errors meet, from the variances of
/// their offsets there.
[[nodiscard]] Eigen::Matrix2d intersection_covariance(const Eigen::Vector2d& position,
                                                      const LineEstimate& first,
                                                      const Eigen::Vector2d& first_normal,
                                                      const LineEstimate& second,
                                                      const Eigen::Vector2d& second_normal);

/// Intersection of two lines with independent errors (CWLF eq. 36, 37; WCTLS eq. 24, 25) and its
/// covariance. Nothing when the lines are parallel to rounding.
[[nodiscard]] std::optional<CornerEstimate> intersect(const LineEstimate& first,
                                                      const LineEstimate& second);

/// The same with the unit normals of the lines, where they are known already.
[[nodiscard]] std::optional<CornerEstimate> intersect(const LineEstimate& first,
                                                      const Eigen::Vector2d& first_normal,
                                                      const LineEstimate& second,
                                                      const Eigen::Vector2d& second_normal);

/// Adds the error that a common range bias makes at `corner`: along the ray to it, not reduced by
/// the number of points.
[[nodiscard]] CornerEstimate with_range_bias(const CornerEstimate& corner,
                                             double range_bias_stddev);

/// Ellipse of a 2x2 covariance.
struct Ellipse {
  double semi_major = 0.0;  ///< [m]
  double semi_minor = 0.0;  ///< [m]
  double direction = 0.0;   ///< [rad] of the major axis, (-pi/2, pi/2]
};

/// Contour at which the squared Mahalanobis distance is `mahalanobis_squared` (1: one sigma).
[[nodiscard]] Ellipse ellipse(const Eigen::Matrix2d& covariance, double mahalanobis_squared);

/// Area of the one-sigma ellipse, pi sqrt(det C) [m^2].
[[nodiscard]] double one_sigma_ellipse_area(const Eigen::Matrix2d& covariance);

}  // namespace quoin
