// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/mapping/wall_belief.hpp"

namespace quoin {

/// Matches the lines of one scan with the walls of a belief.
///
/// One line at a time, the longest first; where that finds few, all lines together; where that
/// does, too, one line at a time in wide gates. With the pose that they give, the rest is looked
/// for.
class WallMatching {
 public:
  /// What the scan is matched with. All that is referred to outlives the object.
  struct Setup {
    std::span<const LineLandmark> map;
    std::span<const LineMeasurement> measurements;
    const WallBelief& base;                    ///< before the motion
    const PoseEstimate& since;                 ///< motion from there by odometry
    const Pose2& moved;                        ///< the same motion with what the points say
    const Eigen::Matrix3d& search_covariance;  ///< of it, to find lines by
  };
  struct Result {
    WallPairs pairs;
    double weakening = 1.0;  ///< of the covariance of the motion, which the walls refute
  };

  explicit WallMatching(const Setup& setup) : s_(setup) {}
  [[nodiscard]] Result find() const;

 private:
  /// In gates as wide as these standard deviations of innovations, [rad] and [m].
  [[nodiscard]] WallPairs one_by_one(WallBelief belief, double direction_stddev,
                                     double offset_stddev) const;
  [[nodiscard]] Result all_together(const WallBelief& belief) const;

  Setup s_;
};

/// Length [m] of the lines that are matched, and of all.
[[nodiscard]] double length_of(const WallPairs& pairs,
                               std::span<const LineMeasurement> measurements);
[[nodiscard]] double length_of(std::span<const LineMeasurement> measurements);

}  // namespace quoin
