// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/calibration/variance_components.hpp"
#include "core/calibration/wall_sample.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// The noise of a sensor while it runs, from the walls of the last scans.
class RunningNoise {
 public:
  struct Settings {
    std::size_t block_points = 10'000;   ///< on walls, after which the estimate is renewed
    std::size_t window_points = 40'000;  ///< that it rests on, the newest
  };

  /// What a block of scans changed.
  enum class Event {
    none,     ///< the block is not complete, or there are too few walls
    renewed,  ///< there is a new estimate
    jump,     ///< there is one of this block alone: the noise is not what it was
  };

  explicit RunningNoise(const Settings& settings) : settings_(settings) {}
  RunningNoise() : RunningNoise(Settings{}) {}

  /// The points of one scan with the walls in it. Renewing the estimate of a window of 40 000
  /// points takes about ten milliseconds.
  Event add(const PointsView& points, std::span<const Segment> walls);

  /// Nothing before the first complete block. Ranges have 0.1 mm of noise at least.
  [[nodiscard]] const std::optional<NoiseComponents>& components() const { return components_; }

 private:
  Settings settings_;
  WallSample window_;
  std::size_t scan_ = 0;
  std::size_t block_begin_ = 0;  // first scan of the block that is being filled
  std::size_t block_points_ = 0;
  std::optional<NoiseComponents> components_;
};

}  // namespace quoin
