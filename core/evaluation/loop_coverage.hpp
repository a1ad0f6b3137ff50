// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "core/evaluation/corner_quality.hpp"
#include "core/evaluation/disturbed_scans.hpp"
#include "core/extraction/extraction.hpp"
#include "core/simulation/world.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// Lines that are long enough for their covariance to be judged.
inline constexpr double judged_line_length = 0.3;  // [m]

/// How true the lines are that were found. A line is of a wall when more than half of its points
/// are on it, or on walls of the same line.
struct LineQuality {
  std::size_t lines = 0;           ///< of at least `judged_line_length`
  std::size_t false_lines = 0;     ///< of them, those of no wall
  Interval coverage;               ///< share of the others in their 95 % ellipse of direction and
                                   ///< offset at the middle of the wall
  double beyond_four_sigma = 0.0;  ///< share of the others
};

/// How true lines and corners and their covariances are when the segments are found, too, not
/// given.
struct LoopCoverage {
  std::size_t scans = 0;
  double segments_per_scan = 0.0;
  double corners_per_scan = 0.0;
  CornerQuality corners;
  LineQuality lines;
  FailureCounts failures{};
};

/// Scans each of `worlds` from the start of its path, `disturbed.scans` times with new noise, and
/// holds what `extraction` finds against the truth. The noise is also the sensor model. World k is
/// scanned with the seed `disturbed.seed` + k.
[[nodiscard]] LoopCoverage judge_loop(Extraction& extraction, std::span<const World> worlds,
                                      const DisturbedScans& disturbed);

}  // namespace quoin
