// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/geometry/pose.hpp"
#include "core/mapping/motion.hpp"
#include "core/simulation/random.hpp"

namespace quoin {

/// What the wheels of a robot count wrong.
struct WheelErrors {
  double slip = 0.0;          ///< they count so much more than was driven
  double heading_bias = 0.0;  ///< [rad/m] turned by so much more
  OdometryNoise noise;        ///< of each increment
};

/// The increment that the wheels count where the robot moves by `increment`.
[[nodiscard]] Pose2 counted_increment(const Pose2& increment, const WheelErrors& errors,
                                      Random& random);

/// Dead reckoning, from the origin of a frame of its own. Same seed, same odometry.
class WheelOdometry {
 public:
  WheelOdometry(const WheelErrors& errors, std::uint64_t seed) : errors_(errors), random_(seed) {}

  /// The robot is here now; the first pose is where it begins.
  void move_to(const Pose2& pose);

  /// Sum of the increments, with the covariance that noise, slip and bias give it when each
  /// increment has its own.
  [[nodiscard]] const PoseEstimate& estimate() const { return estimate_; }

 private:
  WheelErrors errors_;
  Random random_;
  std::optional<Pose2> true_pose_;
  PoseEstimate estimate_;
};

}  // namespace quoin
