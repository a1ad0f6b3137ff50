// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/calibration/noise_estimate.hpp"
#include "core/calibration/wall_sample.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Estimates the noise of a 2D LiDAR from scans of rooms with walls, nothing else being known: the
/// sensor may stand or drive. What is off a wall's own line shows the noise of the rays; what the
/// two halves of a wall differ by beyond that shows what neighbouring rays share.
///
/// Walls are what the caller's segmenter found. Every figure is one of medians over walls or of
/// bounded influence, so that doors, people and clutter do not decide.
class NoiseEstimator {
 public:
  /// Keeps about so many points: when there are more, every second scan is forgotten and only
  /// every second one taken from then on, so that what is kept is spread over the whole recording.
  explicit NoiseEstimator(std::size_t capacity = 400'000) : capacity_(capacity) {}

  /// The points of one scan and the walls in it.
  void add(const PointsView& points, std::span<const Segment> walls);

  [[nodiscard]] std::size_t scans() const { return scans_; }

  /// From all that is kept; intervals by the jackknife over groups of consecutive walls. All
  /// zero without walls; the iteration begins with `start`.
  [[nodiscard]] NoiseEstimate estimate(const SensorModel& start = {}) const;

  /// The same without intervals, in a fraction of the time.
  [[nodiscard]] NoiseComponents components(const SensorModel& start = {}) const;

 private:
  std::size_t capacity_;
  std::size_t scans_ = 0;   // given
  std::size_t stride_ = 1;  // of the scans that are kept
  WallSample sample_;
};

}  // namespace quoin
