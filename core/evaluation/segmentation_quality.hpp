// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/world.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// Which visible walls a segmenter must find: at least so many points and so long (the values of
/// Nguyen et al. 2007). Pieces of walls that are smaller are neither required nor false.
struct WorthFinding {
  std::size_t min_points = 9;
  double min_length = 0.5;  ///< [m]
};

/// What makes a match of a found and a true segment: more than half of the found points on the
/// wall, more than half of the true ones in the found segment, and a line that passes the middle of
/// the true one so near and at so small an angle. A wall that something stands in front of has
/// several true segments, all of which one found segment may match.
struct Matching {
  double distance = 0.1;               ///< [m]
  double angle = 0.17453292519943295;  ///< [rad] 10 deg
};

/// How well a segmenter finds the walls. The measures of Nguyen et al., "A comparison of line
/// extraction algorithms using 2D range data for indoor mobile robotics", 2007.
struct SegmentationQuality {
  std::size_t scans = 0;
  std::size_t true_segments = 0;
  std::size_t found_segments = 0;
  std::size_t matches = 0;      ///< true segments that were found
  Interval true_positive_rate;  ///< matches / true segments
  Interval
      false_positive_rate;    ///< neither matching nor of a wall too small to be required / found
  double alpha_stddev = 0.0;  ///< [rad] of the lines of matched segments from the true ones
  double r_stddev = 0.0;      ///< [m]
};

/// Segments one scan from the start of each world's path, `scans_per_world` times with new noise.
/// The sensor model given to the segmenter is the true one.
[[nodiscard]] SegmentationQuality judge_segmentation(
    const Segmenter& segmenter, std::span<const World> worlds, const SensorModel& noise,
    std::size_t scans_per_world, std::uint64_t seed, const WorthFinding& worth = {});

}  // namespace quoin
