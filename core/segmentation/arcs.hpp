// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/segmentation/block_test.hpp"
#include "core/segmentation/breakpoints.hpp"
#include "core/segmentation/pieces.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Unites neighbouring pieces of one round thing and marks them as round: a circle explains their
/// points and lines do not explain them better. The pieces have been fitted. `blocks` becomes the
/// blocks of each, tested unless it is round.
void find_arcs(const PointsView& points, const SensorModel& sensor, const Tolerance& tolerance,
               double flatness, std::vector<Piece>& pieces, std::vector<TestedBlocks>& blocks);

/// Finds the round things of few points, such as legs and poles, among the points of a scan that
/// are on no segment and no arc: runs of at least five between breaks that are convex towards the
/// sensor and an arc by the same test as longer ones. A leg in front of a wall that goes on behind
/// it lies inside of the segment: all of its points are foreign. Keeps its memory.
class ThinThings {
 public:
  /// Adds them to `found.arcs`, which stay ascending. `breakpoints` has seen the scan.
  void find(const PointsView& scan, const SensorModel& sensor, const Tolerance& tolerance,
            const BreakpointDetector& breakpoints, double flatness, Segmentation& found);

 private:
  CoarsePoints coarse_;
  std::vector<Segment> taken_;
};

}  // namespace quoin
