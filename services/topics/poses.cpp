// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/poses.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/geometry/angle.hpp"

namespace quoin::topics {

namespace {

msg::PoseStatus status_message(LocalizationStatus status) {
  switch (status) {
    case LocalizationStatus::tracking:
      return msg::PoseStatus::POSE_TRACKING;
    case LocalizationStatus::ambiguous:
      return msg::PoseStatus::POSE_AMBIGUOUS;
    case LocalizationStatus::lost:
      break;
  }
  return msg::PoseStatus::POSE_LOST;
}

}  // namespace

msg::PoseEstimate pose_message(const PoseEstimate& estimate) {
  msg::PoseEstimate message;
  message.x(estimate.pose.x);
  message.y(estimate.pose.y);
  message.theta(normalized_angle(estimate.pose.theta));
  const Eigen::Matrix3d& c = estimate.covariance;
  message.covariance_xx(c(0, 0));
  message.covariance_xy(c(0, 1));
  message.covariance_yy(c(1, 1));
  message.covariance_x_theta(c(0, 2));
  message.covariance_y_theta(c(1, 2));
  message.covariance_theta(c(2, 2));
  return message;
}

PoseEstimate pose_estimate(const msg::PoseEstimate& message) {
  PoseEstimate estimate{{message.x(), message.y(), message.theta()}, {}};
  const double xy = message.covariance_xy();
  const double x_theta = message.covariance_x_theta();
  const double y_theta = message.covariance_y_theta();
  estimate.covariance << message.covariance_xx(), xy, x_theta,  //
      xy, message.covariance_yy(), y_theta,                     //
      x_theta, y_theta, message.covariance_theta();
  return estimate;
}

bool valid(const msg::PoseEstimate& message) {
  const PoseEstimate estimate = pose_estimate(message);
  // Beyond this [m] a double does not tell millimetres apart any more.
  constexpr double farthest = 1e9;
  return std::abs(estimate.pose.x) < farthest && std::abs(estimate.pose.y) < farthest &&
         std::abs(estimate.pose.theta) < farthest && estimate.covariance.allFinite() &&
         (estimate.covariance.diagonal().array() >= 0.0).all();
}

void fill_status(const Localization& result, std::size_t lines, bool odometry, msg::Pose& out) {
  out.status(status_message(result.status));
  out.weak_direction(result.weak_direction.value_or(std::numeric_limits<double>::quiet_NaN()));
  out.odometry(odometry);
  out.lines(static_cast<std::uint32_t>(lines));
  out.matched(static_cast<std::uint32_t>(result.matched));
}

}  // namespace quoin::topics
