// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Points on walls, kept from scan to scan in little memory.
class WallSample {
 public:
  /// Walls of fewer points say next to nothing of noise.
  static constexpr std::size_t fewest_points = 6;

  struct Wall {
    std::size_t scan = 0;
    std::size_t begin = 0, end = 0;  // in the kept points
    [[nodiscard]] std::size_t size() const { return end - begin; }
  };

  void add(std::size_t scan, const PointsView& points, std::span<const Segment> walls);
  /// Forgets the scans whose number is not a multiple of `stride`.
  void thin(std::size_t stride);
  /// Forgets the scans before `scan`.
  void forget_before(std::size_t scan);

  [[nodiscard]] std::span<const Wall> walls() const { return walls_; }
  [[nodiscard]] std::span<const float> ranges() const { return ranges_; }
  /// The points of one wall, computed anew.
  void points_of(const Wall& wall, Points& points) const;

 private:
  template <class Keep>
  void keep_if(const Keep& keep);

  std::vector<Wall> walls_;
  std::vector<float> ranges_, bearings_;
};

}  // namespace quoin
