// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/circles/circle_fit.hpp"
#include "core/fitting/fit.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Time [s] that one call takes: the best of several runs of at least `run_time` [s] each, because
/// other load of the machine only makes a run longer.
[[nodiscard]] double seconds_per_call(const std::function<void()>& function,
                                      double run_time = 0.002);

/// Several noisy walls of `points` points each, to be fitted in turn, so that neither branches nor
/// the number of iterations are those of one wall.
[[nodiscard]] std::vector<Points> timing_walls(std::size_t points);

/// The same of columns, from edge to edge.
[[nodiscard]] std::vector<Points> timing_columns(std::size_t points);

/// Covariance of x and y [m^2] with Eigen: the mean, then the products about it. The plain thing to
/// do with the points of a segment, and a measure of what a fit costs.
[[nodiscard]] Eigen::Matrix2d plain_covariance(const PointsView& points);

/// Time [s] of one fit with its covariance, mean over the walls.
[[nodiscard]] double seconds_per_fit(const Fitter& fitter, const std::vector<Points>& walls);
[[nodiscard]] double seconds_per_fit(const CircleFitter& fitter,
                                     const std::vector<Points>& columns);
/// Time [s] of one plain covariance.
[[nodiscard]] double seconds_per_plain_covariance(const std::vector<Points>& walls);

}  // namespace quoin
