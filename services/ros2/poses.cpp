// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/poses.hpp"

#include <array>
#include <cmath>

#include "services/topics/poses.hpp"

namespace quoin::ros2 {

namespace {

using PoseInSpace = geometry_msgs::msg::dds_::Pose_;
using Rotation = geometry_msgs::msg::dds_::Quaternion_;
using Covariance = std::array<double, 36>;

// Rows and columns of a covariance.
constexpr std::size_t row_x = 0;
constexpr std::size_t row_y = 1;
constexpr std::size_t row_yaw = 5;

// [rad] A floor that tilts by more is no plane.
constexpr double most_tilt = 0.2;

constexpr std::size_t at(std::size_t row, std::size_t column) { return 6 * row + column; }

Rotation rotation_of(double theta) {
  Rotation rotation;
  rotation.z(std::sin(0.5 * theta));
  rotation.w(std::cos(0.5 * theta));
  return rotation;
}

void fill(const msg::PoseEstimate& in, PoseInSpace& pose, Covariance& covariance) {
  pose.position().x(in.x());
  pose.position().y(in.y());
  pose.position().z(0.0);
  pose.orientation(rotation_of(in.theta()));
  covariance.fill(0.0);
  covariance[at(row_x, row_x)] = in.covariance_xx();
  covariance[at(row_y, row_y)] = in.covariance_yy();
  covariance[at(row_yaw, row_yaw)] = in.covariance_theta();
  covariance[at(row_x, row_y)] = covariance[at(row_y, row_x)] = in.covariance_xy();
  covariance[at(row_x, row_yaw)] = covariance[at(row_yaw, row_x)] = in.covariance_x_theta();
  covariance[at(row_y, row_yaw)] = covariance[at(row_yaw, row_y)] = in.covariance_y_theta();
}

double seconds(std::int64_t stamp) { return static_cast<double>(stamp) * 1e-9; }

Pose2 pose_of(const msg::PoseEstimate& estimate) {
  return {estimate.x(), estimate.y(), estimate.theta()};
}

}  // namespace

void fill_pose(const msg::Pose& in, PoseWithCovarianceStamped& out) {
  set_header(out.header(), in.header().stamp(), in.header().frame());
  fill(in.pose(), out.pose().pose(), out.pose().covariance());
}

void fill_odometry(const msg::Odometry& in, Odometry& out) {
  set_header(out.header(), in.header().stamp(), in.header().frame());
  out.child_frame_id(in.child_frame());
  fill(in.pose(), out.pose().pose(), out.pose().covariance());
  const bool known = in.velocity_known();
  out.twist().twist().linear().x(known ? in.velocity_x() : 0.0);
  out.twist().twist().linear().y(known ? in.velocity_y() : 0.0);
  out.twist().twist().angular().z(known ? in.velocity_theta() : 0.0);
  // The first is -1 where the velocity is not known.
  out.twist().covariance().fill(0.0);
  if (!known) out.twist().covariance()[0] = -1.0;
}

TransformStamped transform(std::int64_t stamp, std::string_view parent, std::string_view child,
                           const Pose2& pose, double height) {
  TransformStamped made;
  set_header(made.header(), stamp, parent);
  made.child_frame_id(std::string(child));
  made.transform().translation().x(pose.x);
  made.transform().translation().y(pose.y);
  made.transform().translation().z(height);
  made.transform().rotation(rotation_of(pose.theta));
  return made;
}

std::optional<TransformStamped> MapToOdom::add(const msg::Odometry& odometry) {
  if (!topics::valid(odometry.pose())) return std::nullopt;
  odom_frame_ = odometry.header().frame();
  child_frame_ = odometry.child_frame();
  const double stamp = seconds(odometry.header().stamp());
  (void)track_.add(stamp, pose_of(odometry.pose()));
  constexpr double longest_wait = 5.0;  // [s] for poses that are late
  track_.forget_before(stamp - longest_wait);
  return resolve();
}

std::optional<TransformStamped> MapToOdom::add(const msg::Pose& pose) {
  if (pose.status() == msg::PoseStatus::POSE_LOST || !topics::valid(pose.pose())) {
    return std::nullopt;
  }
  waiting_ = pose;
  return resolve();
}

std::optional<TransformStamped> MapToOdom::resolve() {
  if (!waiting_ || track_.empty()) return std::nullopt;
  if (waiting_->child_frame() != child_frame_) {
    ++other_frames_;
    waiting_.reset();
    return std::nullopt;
  }
  const auto odometry = track_.at(seconds(waiting_->header().stamp()));
  if (!odometry) return std::nullopt;
  const Pose2 map_to_base = pose_of(waiting_->pose());
  const Pose2 base_to_odom = between(*odometry, Pose2{});
  const TransformStamped made = transform(waiting_->header().stamp(), waiting_->header().frame(),
                                          odom_frame_, compose(map_to_base, base_to_odom));
  waiting_.reset();
  return made;
}

std::string_view text_of(OdometryFault fault) {
  switch (fault) {
    case OdometryFault::not_finite:
      return "a pose or covariance that is no number: left out";
    case OdometryFault::no_rotation:
      return "an orientation that is no rotation: left out";
    case OdometryFault::tilted:
      return "roll or pitch beyond 0.2 rad: the yaw is taken";
    case OdometryFault::no_frames:
      return "no frame_id or child_frame_id";
    case OdometryFault::stamp_zero:
      return "the stamp is 0: the time of arrival is taken";
    case OdometryFault::stamp_not_later:
      return "the stamp is not later than that of the message before";
  }
  return "";
}

void OdometryImport::note(OdometryFault fault) {
  ++counts_[fault];
  ++faults_;
}

bool OdometryImport::convert(const Odometry& in, std::int64_t received, msg::Odometry& out) {
  const Rotation& q = in.pose().pose().orientation();
  const double norm = std::sqrt(q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w());
  // Messages that were never filled in have the quaternion 0.
  if (!(norm > 0.5 && norm < 2.0)) {
    note(OdometryFault::no_rotation);
    return false;
  }
  msg::PoseEstimate& pose = out.pose();
  const double yaw_y = 2.0 * (q.w() * q.z() + q.x() * q.y());
  const double yaw_x = norm * norm - 2.0 * (q.y() * q.y() + q.z() * q.z());
  pose.x(in.pose().pose().position().x());
  pose.y(in.pose().pose().position().y());
  pose.theta(std::atan2(yaw_y, yaw_x));
  const Covariance& covariance = in.pose().covariance();
  const bool known = covariance[0] >= 0.0;  // by convention -1 where it is not
  const auto element = [&](std::size_t row, std::size_t column) {
    return known ? covariance[at(row, column)] : 0.0;
  };
  pose.covariance_xx(element(row_x, row_x));
  pose.covariance_xy(element(row_x, row_y));
  pose.covariance_yy(element(row_y, row_y));
  pose.covariance_x_theta(element(row_x, row_yaw));
  pose.covariance_y_theta(element(row_y, row_yaw));
  pose.covariance_theta(element(row_yaw, row_yaw));
  if (!topics::valid(pose)) {
    note(OdometryFault::not_finite);
    return false;
  }
  // The z axis of the body, seen from above.
  const double upright = 1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y()) / (norm * norm);
  if (upright < std::cos(most_tilt)) note(OdometryFault::tilted);
  if (in.header().frame_id().empty() || in.child_frame_id().empty()) {
    note(OdometryFault::no_frames);
  }
  out.header().frame(in.header().frame_id());
  out.child_frame(in.child_frame_id());
  std::int64_t stamp = nanoseconds(in.header().stamp());
  if (stamp == 0) {
    note(OdometryFault::stamp_zero);
    stamp = received;
  }
  if (stamp_ != 0 && stamp <= stamp_) note(OdometryFault::stamp_not_later);
  stamp_ = stamp;
  out.header().stamp(stamp);
  const auto& twist = in.twist().twist();
  out.velocity_x(twist.linear().x());
  out.velocity_y(twist.linear().y());
  out.velocity_theta(twist.angular().z());
  out.velocity_known(in.twist().covariance()[0] >= 0.0 && std::isfinite(twist.linear().x()) &&
                     std::isfinite(twist.linear().y()) && std::isfinite(twist.angular().z()));
  return true;
}

}  // namespace quoin::ros2
