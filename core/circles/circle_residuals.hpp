// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/circles/circle_fit.hpp"
#include "core/fitting/point_sums.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Sums over the points of an arc with the weights 1 / v, g = (normal_x, normal_y, 1) being the
/// gradient of the distance d of a point from the circle and v the variance of d:
///
/// v = V_rho cos^2(phi) + V_theta sin^2(phi), phi the incidence angle, V_rho the variance of the
/// range and V_theta that of the bearing times the squared range. The noise along the circle, of
/// the variance u = V_rho sin^2(phi) + V_theta cos^2(phi), makes d larger by u / (2 radius) on
/// average, which is taken off, and uncertain by 3 u^2 / (2 radius^2), which is added to v: half
/// of u^2 / radius^2 for the bow itself, and once for where on the bow the point is.
///
/// The gradient and v are taken where the point most likely is on the circle (the foot, by the
/// noise's metric) and not where it was measured, whose error the distance has a part of. Without
/// that the estimate would be biased like orthogonal fits of lines are.
struct CircleSums {
  double xx = 0.0, xy = 0.0, yy = 0.0, x = 0.0, y = 0.0, one = 0.0;  ///< of g g^T / v
  double distance_x = 0.0, distance_y = 0.0, distance = 0.0;         ///< of g d / v
  double xxx = 0.0, xxy = 0.0;  ///< of normal_x^2 normal_x and normal_x^2 normal_y, over v
  double chi_square = 0.0;      ///< of d^2 / v
  double along = 0.0;           ///< of u, not weighted

  /// Of Fisher.
  [[nodiscard]] Eigen::Matrix3d information() const {
    return Eigen::Matrix3d{{xx, xy, x}, {xy, yy, y}, {x, y, one}};
  }
  [[nodiscard]] Eigen::Vector3d gradient() const { return {distance_x, distance_y, distance}; }
};

[[nodiscard]] CircleSums circle_sums(const PointsView& points, const Circle& circle,
                                     const WeightVariances& variances);

/// What the noise makes of a circle whose points have one weight.
struct EqualWeights {
  Eigen::Matrix3d covariance;  ///< [m^2] H^-1 (sum of v g g^T) H^-1 with H the sum of g g^T
  Eigen::Vector3d bias;        ///< [m] of second order, if its algebraic distance has one weight
  Eigen::Vector3d by_scale;    ///< [m] what a constraint adds to that: H^-1 (sum of v) (mean n, 0)
  Eigen::Vector3d by_radius;   ///< [m] and H^-1 (sum of v) (0, 0, 1), both over the radius
};

/// Nothing when H is singular. With e and t the errors across and along the circle, of variances v
/// and u and covariance c, the algebraic distance F = |p - center|^2 - radius^2 is
/// 2 radius e + e^2 + t^2, and the expectations of F and of F (p - center) are not zero:
/// bias = H^-1 sum of ((3 v + u) normal / 2 + c tangent, (v + u) / 2) / radius.
[[nodiscard]] std::optional<EqualWeights> equal_weights(const PointsView& points,
                                                        const Circle& circle,
                                                        const WeightVariances& variances);

/// Inverse of a symmetric matrix by its cofactors; nothing when it is not positive definite beyond
/// rounding.
[[nodiscard]] std::optional<Eigen::Matrix3d> inverse_of(const Eigen::Matrix3d& matrix);

/// Adds what an error common to all ranges does, which is not reduced by the number of points.
/// `weighted` says which of the two fits the circle is from.
void add_range_bias(const PointsView& points, const SensorModel& sensor, bool weighted,
                    CircleEstimate& estimate);

/// The fit of `points` points with what the sums say of it, or its failure.
[[nodiscard]] CircleFit judged(const CircleEstimate& estimate, const CircleSums& sums,
                               std::size_t points, const CircleParameters& parameters);

}  // namespace quoin
