// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// The votes of points for the lines through them, by the direction of the normal and the distance
/// from the middle of the points: the smaller a cluster, the fewer cells, and the less the width of
/// a direction moves its ends.
class HoughVotes {
 public:
  /// Widths of a cell [rad] and [m]. The distance is divided more coarsely when the points are
  /// farther apart than most_offsets cells.
  HoughVotes(double angle_resolution, double offset_resolution);

  static constexpr std::size_t most_offsets = 2048;

  /// Forgets all votes and lets these points vote.
  void start(const PointsView& points, const Segment& cluster);

  struct Peak {
    std::int32_t votes = 0;
    NormalLine line;  ///< of the middle of the cell
    std::size_t cell = 0;
  };
  /// The cell with most votes.
  [[nodiscard]] Peak peak() const;

  /// The cell shall not be the peak again.
  void discard(std::size_t cell);

  /// Takes the votes of these points back, each at most once.
  void take_back(const PointsView& points, const Segment& run);

 private:
  void vote(double x, double y, std::int32_t change);

  double offset_resolution_;
  std::vector<double> cosines_, sines_;  // of each direction
  std::vector<std::int32_t> cells_;      // offsets of one direction after the other
  std::vector<std::uint8_t> voting_;     // whether point i of the cluster does
  std::size_t first_ = 0;                // of the cluster
  std::size_t offsets_ = 1;              // for each direction
  double x_ = 0.0, y_ = 0.0;             // [m] middle
  double lowest_ = 0.0;                  // [m] distance where the first cell begins
  double width_ = 1.0;                   // [m]
};

}  // namespace quoin
