// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/geometry/line.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Smallest covariance of (alpha, r) [rad^2, rad m; rad m, m^2] that any unbiased fit of `line` to
/// points at these bearings can have: the inverse of the Fisher information, the sum of [t^2, -t;
/// -t, 1] / v over the points, with t the coordinate along the line and v the variance of the
/// distance from it. `points` are without noise and at least two.
[[nodiscard]] Eigen::Matrix2d cramer_rao_bound(const Line& line, const PointsView& points,
                                               const SensorModel& noise);

}  // namespace quoin
