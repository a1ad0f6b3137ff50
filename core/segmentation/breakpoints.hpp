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
///   D_max = r sin(dphi) / sin(lambda - dphi) + 3 (range_stddev + range_stddev_per_metre r),
///
/// the distance on a wall that is met at the grazing angle lambda, plus noise. Here r is the
/// smaller of the two ranges, so that the answer does not depend on the sense of rotation. A step
/// of lambda or more always breaks; lambda is at least three of the scan's typical steps. Where
/// rays are missing, that is over more than three such steps, D_max says nothing (it grows beyond
/// all bounds): there a surface ends at a gap of `max_gap`.
class BreakpointDetector {
 public:
  BreakpointDetector(double lambda, double max_gap);  ///< [rad] in (0, pi / 2), [m]

  /// Fills `clusters` with the runs between breaks, ascending; empty without points. Returns
  /// whether the last point and the first belong to different surfaces.
  bool find(const CoarsePoints& points, const SensorModel& sensor, std::vector<Segment>& clusters);

  /// Whether point `j` may be the next on the surface of point `i`, of the points of the last scan.
  [[nodiscard]] bool connected(const CoarsePoints& points, std::size_t i, std::size_t j) const;

  /// Of one scan.
  struct Criterion {
    float sine_lambda;
    float cosine_lambda;
    float range_noise;    ///< [m] 3 range_stddev
    float range_growth;   ///< 3 range_stddev_per_metre
    float bearing_noise;  ///< [rad] 3 bearing_stddev
    float wide_step;      ///< sine of the step beyond which rays are missing
    float gap_squared;    ///< [m^2] that a surface passes over there
  };

 private:
  float lambda_;
  float gap_squared_;
  Criterion criterion_{};
  std::vector<std::uint8_t> breaks_;  // 1 for each point that belongs to a new surface
};

}  // namespace quoin
