// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/wheel_odometry.hpp"

#include <cmath>

namespace quoin {

Pose2 counted_increment(const Pose2& increment, const WheelErrors& errors, Random& random) {
  Eigen::Vector3d twist = twist_of(increment);
  const double driven = std::hypot(twist.x(), twist.y());
  const OdometryNoise& noise = errors.noise;
  // Every increment takes the same number of random numbers, so that one setting does not shift the
  // rest.
  const double along = noise.translation_per_metre * driven * random.normal();
  const double across = noise.sideways_per_metre * driven * random.normal();
  const double floor_along = noise.translation_floor * random.normal();
  const double floor_across = noise.translation_floor * random.normal();
  const double heading = noise.heading_per_metre * driven * random.normal() +
                         noise.heading_per_radian * twist.z() * random.normal() +
                         noise.heading_floor * random.normal();
  twist.head<2>() *= 1.0 + errors.slip;
  twist.x() += along + floor_along;
  twist.y() += across + floor_across;
  twist.z() += errors.heading_bias * driven + heading;
  return after_twist(twist, 1.0);
}

void WheelOdometry::move_to(const Pose2& pose) {
  if (true_pose_) {
    const Pose2 counted = counted_increment(between(*true_pose_, pose), errors_, random_);
    OdometryNoise noise = errors_.noise;
    noise.translation_per_metre = std::hypot(noise.translation_per_metre, errors_.slip);
    noise.heading_per_metre = std::hypot(noise.heading_per_metre, errors_.heading_bias);
    estimate_ = compose(estimate_, PoseEstimate{counted, noise.covariance(counted)});
  }
  true_pose_ = pose;
}

}  // namespace quoin
