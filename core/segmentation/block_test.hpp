// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/fitting/point_sums.hpp"
#include "core/geometry/line.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Mean of the points of a block.
struct BlockMean {
  double x = 0.0, y = 0.0;  ///< [m]
  double weight = 0.0;      ///< number of points
};

inline constexpr std::size_t most_blocks = 8;

/// Means of the parts of a run of points, which are as equal as can be: 4, or 8 of 32 points and
/// more; no more than there are points.
class BlockMeans {
 public:
  BlockMeans() = default;
  /// Of points [begin, end).
  BlockMeans(const PointsView& points, const Segment& segment);
  /// Of the points at these indices.
  BlockMeans(const PointsView& points, std::span<const std::size_t> indices);

  [[nodiscard]] std::span<const BlockMean> means() const { return {means_.data(), count_}; }
  [[nodiscard]] const Moments& moments() const { return moments_; }

 private:
  void add_up();

  std::array<BlockMean, most_blocks> means_;
  std::size_t count_ = 0;
  Moments moments_;  // each mean with the number of its points
};

/// The line of the means, and what they say against it.
struct BlockTest {
  NormalLine line;
  bool crooked = false;  ///< the means are off the line by more than noise and flatness explain
};

[[nodiscard]] BlockTest test_blocks(const BlockMeans& blocks, const SensorModel& sensor,
                                    double flatness);

/// Of one run of points.
struct TestedBlocks {
  BlockMeans means;
  BlockTest test;
};

/// A wall that is shorter has to be clearly straight.
inline constexpr double short_wall = 0.5;  // [m]

}  // namespace quoin
