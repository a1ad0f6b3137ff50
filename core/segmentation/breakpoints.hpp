// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Adaptive breakpoint detector: Borges and Aldon, "Line extraction in 2D range images for mobile
/// robotics", 2004. Two neighbours belong to different surfaces when they are farther apart than
///
///   D_max = r sin(dphi) / sin(lambda - dphi) + 3 range_stddev,
///
/// the distance on a wall that is met at the grazing angle lambda, plus noise. Here r is the
/// smaller of the two ranges, so that the answer does not depend on the sense of rotation. A step
/// of lambda or more always breaks.
class BreakpointDetector {
 public:
  explicit BreakpointDetector(double lambda);  ///< [rad] in (0, pi / 2)

  /// Fills `clusters` with the runs between breaks, ascending; empty without points. Returns
  /// whether the last point and the first belong to different surfaces.
  bool find(const CoarsePoints& points, const SensorModel& sensor, std::vector<Segment>& clusters);

 private:
  float sine_;
  float cosine_;
  std::vector<std::uint8_t> breaks_;  // 1 for each point that belongs to a new surface
};

}  // namespace quoin
