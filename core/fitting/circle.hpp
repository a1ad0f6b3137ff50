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
