// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/pose.hpp"

namespace quoin {

/// A segment with a side, for comparing two sets of them.
struct SidedSegment {
  double normal = 0.0;                               ///< [rad] away from the side it is seen from
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< [m]
  double half_length = 0.0;                          ///< [m]
};

/// Where an alignment is looked for, and what counts as the same wall.
struct AlignmentSearch {
  Pose2 center;                      ///< of the search
  double largest_translation = 1e9;  ///< [m] from it, in x and in y
  double largest_turn = 4.0;         ///< [rad] from it
  double angle_tolerance = 0.07;     ///< [rad] of walls that match
  double offset_tolerance = 0.15;    ///< [m] across them
  double pivot = 0.0;                ///< [m] how far the segments are from what turns: with the
                                     ///< turn it adds to the translation that is allowed
};

/// A pose of the first set in the frame of the second.
struct Alignment {
  Pose2 pose;
  double support = 0.0;  ///< [m] of walls that lie on walls, less for those that lie worse
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< of the first and the second set
};

/// The poses in which segments of `first` lie on segments of `second` with the same side, the best
/// supported first; at most `count`, apart by more than 0.3 m or 10 deg from each other. Every pair
/// of crossing walls in one set and in the other makes one hypothesis.
[[nodiscard]] std::vector<Alignment> align(std::span<const SidedSegment> first,
                                           std::span<const SidedSegment> second,
                                           const AlignmentSearch& search, std::size_t count = 3);

}  // namespace quoin
