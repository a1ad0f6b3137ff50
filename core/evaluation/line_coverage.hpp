// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/fitting/fit.hpp"
#include "core/sensor/points.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// A wall by itself, and how it is seen.
struct SingleWall {
  double length = 1.0;     ///< [m]
  double distance = 1.0;   ///< [m] of its mid-point
  double incidence = 0.0;  ///< [rad] between the ray to the mid-point and the normal, [0, pi / 2)
};

/// How often the covariance of its line holds the truth.
struct LineCoverage {
  std::size_t trials = 0;    ///< in which there was a line
  std::size_t few_rays = 0;  ///< in which fewer rays than asked for met the wall
  double points = 0.0;       ///< mean number of them in the others
  Interval middle;           ///< of direction and offset at the mid-point, in their 95 % ellipse
  Interval alpha_r;          ///< of (alpha, r) in theirs, where that is said to be Gaussian
  double gaussian = 0.0;     ///< share of the lines of which that is said
};

/// Monte Carlo with `rays` a revolution, their bearings shifted anew in each trial; the points are
/// those of the wall, no other. Same seed, same result.
[[nodiscard]] LineCoverage judge_wall(const Fitter& fitter, const SingleWall& wall,
                                      const SensorModel& noise, std::size_t rays,
                                      std::size_t fewest_points, std::size_t trials,
                                      std::uint64_t seed);

}  // namespace quoin
