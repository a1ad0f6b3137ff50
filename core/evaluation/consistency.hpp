// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/evaluation/scene.hpp"
#include "core/fitting/fit.hpp"
#include "core/geometry/line.hpp"
#include "core/sensor/points.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// Smallest covariance of (alpha, r) [rad^2, rad m; rad m, m^2] that any unbiased fit of `line` to
/// points at these bearings can have: the inverse of the Fisher information, the sum of [t^2, -t;
/// -t, 1] / v over the points, with t the coordinate along the line and v the variance of the
/// distance from it. `points` are without noise and at least two.
[[nodiscard]] Eigen::Matrix2d cramer_rao_bound(const Line& line, const PointsView& points,
                                               const SensorModel& noise);

/// How true the covariance of one corner is.
struct CornerConsistency {
  Eigen::Vector2d position;  ///< [m] true, in the sensor's frame
  std::size_t trials = 0;    ///< in which both lines were found
  Interval nees;             ///< mean squared Mahalanobis distance from the truth; 2 is right
  Interval coverage95;       ///< of the 95 % ellipse
  double rmse = 0.0;         ///< [m] root of the mean squared distance from the truth
  double bound = 0.0;        ///< [m] the same for an estimator that attains the Cramer-Rao bound
  Eigen::Vector2d bias;      ///< [m] mean error
};

/// How true the covariances of one fitter are in one scene with one noise, points assigned to their
/// true walls.
struct Consistency {
  std::size_t trials = 0;
  Interval nees;                    ///< over all corners
  Interval coverage95;              ///< over all corners
  double rmse_over_crb = 0.0;       ///< median over the corners
  Interval rmse_over_crb_interval;  ///< the same, spread taken from batches of the trials
  /// Largest distance of a corner's coverage from 95 %, in standard errors of that coverage.
  double worst_corner = 0.0;
  FailureCounts failures{};
  std::vector<CornerConsistency> corners;
};

/// Monte Carlo: every trial measures all walls of the scene anew, fits them and intersects the
/// neighbours. Same seed, same result, on every machine of the same floating-point arithmetic.
[[nodiscard]] Consistency judge_consistency(const Fitter& fitter, const Scene& scene,
                                            const SensorModel& noise, std::size_t trials,
                                            std::uint64_t seed);

}  // namespace quoin
