// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/motion_fusion.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/geometry/angle.hpp"

namespace quoin {

PoseEstimate compose_correlated(const PoseEstimate& first, const PoseEstimate& increment) {
  const Eigen::Matrix3d by_first = compose_by_first(first.pose, increment.pose);
  const Eigen::Matrix3d by_second = compose_by_second(first.pose);
  const Eigen::Matrix3d a = by_first * first.covariance * by_first.transpose();
  const Eigen::Matrix3d b = by_second * increment.covariance * by_second.transpose();
  const double trace_a = a.trace();
  const double trace_b = b.trace();
  if (!(trace_a > 0.0) || !(trace_b > 0.0)) return {compose(first.pose, increment.pose), a + b};
  const double s = std::sqrt(trace_b / trace_a);
  return {compose(first.pose, increment.pose), (1.0 + s) * a + (1.0 + 1.0 / s) * b};
}

PoseEstimate fuse(PoseEstimate& odometry, const PoseEstimate& points) {
  const Eigen::Matrix3d& noise = points.covariance;
  const Eigen::Vector3d off(points.pose.x - odometry.pose.x, points.pose.y - odometry.pose.y,
                            normalized_angle(points.pose.theta - odometry.pose.theta));
  const double squared = off.dot((noise + odometry.covariance).ldlt().solve(off));
  if (squared > 3.0) odometry.covariance *= squared / 3.0;
  const Eigen::Matrix3d gain = odometry.covariance * (odometry.covariance + noise).inverse();
  const Eigen::Vector3d change = gain * off;
  PoseEstimate fused{moved(odometry.pose, change),
                     odometry.covariance - gain * odometry.covariance};
  fused.covariance = (0.5 * (fused.covariance + fused.covariance.transpose())).eval();
  return fused;
}

void OdometryScale::judge(const PoseEstimate& motion, const Pose2& step,
                          const Eigen::Matrix3d& noise) {
  const Eigen::Vector3d off(step.x - motion.pose.x, step.y - motion.pose.y,
                            normalized_angle(step.theta - motion.pose.theta));
  const double position =
      motion.covariance(0, 0) + motion.covariance(1, 1) + 2.0 * (noise(0, 0) + noise(1, 1));
  const double heading = motion.covariance(2, 2) + 2.0 * noise(2, 2);
  const Eigen::Vector2d ratio(off.head<2>().squaredNorm() / position, off.z() * off.z() / heading);
  judged_ = std::min<std::size_t>(judged_ + 1, 50);
  const double weight = 1.0 / (5.0 + static_cast<double>(judged_));
  for (int i = 0; i < 2; ++i) {
    scale_(i) += weight * (std::min(ratio(i), 100.0) - scale_(i));
    scale_(i) = std::max(scale_(i), 1.0);
  }
}

PoseEstimate OdometryScale::scaled(const PoseEstimate& increment) const {
  Eigen::Vector3d scale(scale_.x(), scale_.x(), scale_.y());
  scale = scale.cwiseSqrt();
  return {increment.pose, scale.asDiagonal() * increment.covariance * scale.asDiagonal()};
}

}  // namespace quoin
