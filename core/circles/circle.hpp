// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/sensor/points.hpp"

namespace quoin {

struct Circle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0.0;                               ///< [m] > 0
};

/// By what the squares of A (x^2 + y^2) + B x + C y + D are divided, so that A = B = C = D = 0 is
/// no solution.
enum class CircleConstraint {
  taubin,  ///< the mean squared gradient (Taubin 1991)
  pratt,   ///< B^2 + C^2 - 4 A D, which is 4 A^2 radius^2 (Pratt 1987)
  hyper,   ///< twice that of Taubin less that of Pratt (Al-Sharadqah and Chernov 2009)
};

/// Circle for which the sum over the points of (A (x^2 + y^2) + B x + C y + D)^2 under the
/// constraint is least: the generalised eigenvector of the smallest positive eigenvalue. Nothing
/// for fewer than three points or when they do not determine a circle, such as on a line.
[[nodiscard]] std::optional<Circle> fit_algebraic_circle(const PointsView& points,
                                                         CircleConstraint constraint);

/// Circle with the least sum of squared distances, each over the variance of the point's noise
/// across the circle: the algebraic fit of Taubin 1991, then Gauss-Newton steps. Nothing for fewer
/// than three points, or when they do not determine a circle, such as on a line.
[[nodiscard]] std::optional<Circle> fit_circle(const PointsView& points, const SensorModel& sensor);

/// Sum over the points of the squared distance from the circle over the variance of the point's
/// noise across it, `variance_floor` [m^2] added to that; its expectation is size - 3.
[[nodiscard]] double chi_square(const Circle& circle, const PointsView& points,
                                const SensorModel& sensor, double variance_floor = 0.0);

/// Angle [rad] about the centre that the points cover from the first to the last, in [0, 2 pi).
[[nodiscard]] double covered_angle(const Circle& circle, const PointsView& points);

}  // namespace quoin
