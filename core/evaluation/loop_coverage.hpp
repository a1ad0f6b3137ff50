// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/extraction/extraction.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/world.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// How true the covariances of corners are when the segments are found, too, not given.
struct LoopCoverage {
  std::size_t scans = 0;
  double segments_per_scan = 0.0;
  double corners_per_scan = 0.0;
  Interval coverage95;             ///< of the 95 % ellipses, over all corners
  Interval nees;                   ///< over the corners within four sigma; 2 is right
  double beyond_four_sigma = 0.0;  ///< fraction of the corners
  FailureCounts failures{};
};

/// Scans `world` from the start of its path, `scans` times with new noise, and holds each corner
/// that `extraction` finds against the nearest true one. The noise is also the sensor model.
[[nodiscard]] LoopCoverage judge_loop(Extraction& extraction, const World& world,
                                      const SensorModel& noise, std::size_t scans,
                                      std::uint64_t seed);

}  // namespace quoin
