// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/calibration/variance_components.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// Standard deviation of ranges about the lines of walls, in a band of ranges or incidences.
struct NoiseBand {
  double low = 0.0, high = 0.0;  ///< [m] of the range, or [rad] of the incidence
  std::size_t points = 0;
  double measured = 0.0;  ///< [m]
  double modelled = 0.0;  ///< [m] by the components
};

/// Components with 95 % intervals, and what they rest on.
struct NoiseEstimate {
  NoiseComponents components;
  Interval range_stddev;            ///< [m]
  Interval range_stddev_per_metre;  ///< without unit
  Interval bearing_stddev;          ///< [rad]
  Interval flatness_stddev;         ///< [m]
  Interval interlace_stddev;        ///< [m]
  Interval neighbour_correlation;
  double middle_range = 0.0;     ///< [m] median of the points on walls
  Interval middle_range_stddev;  ///< [m] of a range there
  double quantization = 0.0;     ///< [m] step of the ranges; 0 when none is seen
  std::size_t scans = 0;         ///< that were given
  std::size_t walls = 0;
  std::size_t long_walls = 0;  ///< of enough points to compare their halves
  std::size_t points = 0;      ///< on walls
  double nearest = 0.0;        ///< [m] range below which 5 % of the points on walls lie
  double farthest = 0.0;       ///< [m] below which 95 % of them lie
  double steepest = 0.0;       ///< [rad] incidence below which 95 % of them are met
  /// Median of the reduced chi square of the walls under the components, 1 when they describe the
  /// scans, and the share of walls that leave their line by more than noise does once in 1000
  /// times.
  double reduced_chi_square = 0.0;
  double refuted = 0.0;
  std::vector<NoiseBand> by_range, by_incidence;
};

/// Why scans do not show the noise of their sensor.
enum class NoiseGap {
  few_walls,          ///< too few to tell anything
  few_long_walls,     ///< too few to compare halves
  wide_interval,      ///< the noise at the middle range is uncertain by more than a quarter
  uniform_range,      ///< all walls equally far: what grows with the range does not show
  uniform_incidence,  ///< all walls met head on: noise of the bearings does not show
  no_walls,           ///< a third of them is none: clutter, round surfaces, a moving scene
};

/// All that is missing; none when the estimate can be used.
[[nodiscard]] std::vector<NoiseGap> gaps_of(const NoiseEstimate& estimate);

}  // namespace quoin
