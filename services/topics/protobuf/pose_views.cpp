// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/pose_views.hpp"

#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"
#include "services/topics/protobuf/scene.hpp"

namespace quoin::topics {

namespace {

constexpr SceneColor map_color{0.45, 0.45, 0.50, 1.0};
constexpr SceneColor pose_color{0.55, 0.25, 0.75, 1.0};

Pose2 pose_of(const msg::PoseEstimate& estimate) {
  return {estimate.x(), estimate.y(), estimate.theta()};
}

template <class Message>
bool fill_pose(const Message& message, foxglove::PoseInFrame& out) {
  set_time(message.header().stamp(), *out.mutable_timestamp());
  out.set_frame_id(message.header().frame());
  set_pose(pose_of(message.pose()), *out.mutable_pose());
  return true;
}

template <class Message>
bool fill_frame(const Message& message, foxglove::FrameTransform& out) {
  if (message.child_frame().empty() || message.child_frame() == message.header().frame()) {
    return false;
  }
  set_transform(message.header().frame(), message.child_frame(), message.header().stamp(),
                pose_of(message.pose()), out);
  return true;
}

}  // namespace

bool show_odometry(const msg::Odometry& message, foxglove::PoseInFrame& out) {
  return fill_pose(message, out);
}

bool show_odometry_frame(const msg::Odometry& message, foxglove::FrameTransform& out) {
  return fill_frame(message, out);
}

bool show_pose(const msg::Pose& message, foxglove::PoseInFrame& out) {
  return fill_pose(message, out);
}

bool show_pose_frame(const msg::Pose& message, foxglove::FrameTransform& out) {
  return message.status() != msg::PoseStatus::POSE_LOST && fill_frame(message, out);
}

bool show_pose_ellipse(const msg::Pose& message, foxglove::SceneUpdate& out) {
  Scene scene(message.header(), out);
  const msg::PoseEstimate& pose = message.pose();
  Eigen::Matrix2d covariance;
  covariance << pose.covariance_xx(), pose.covariance_xy(), pose.covariance_xy(),
      pose.covariance_yy();
  foxglove::SceneEntity& entity = scene.add("pose");
  Scene::add_ellipse(entity, pose.x(), pose.y(), ellipse(covariance, chi_square_2_95), pose_color);
  Scene::describe(entity, "x", pose.x(), "m");
  Scene::describe(entity, "y", pose.y(), "m");
  Scene::describe(entity, "theta", pose.theta(), "rad");
  Scene::describe(entity, "lines", message.lines());
  Scene::describe(entity, "matched", message.matched());
  return true;
}

bool show_line_map(const msg::LineMap& message, foxglove::SceneUpdate& out) {
  foxglove::SceneEntity& entity = *out.add_entities();
  set_time(message.header().stamp(), *entity.mutable_timestamp());
  entity.set_frame_id(message.header().frame());
  entity.set_id("part " + std::to_string(message.part()));
  Scene::describe(entity, "walls", static_cast<double>(message.lines().size()));
  foxglove::LinePrimitive& walls =
      Scene::add_line(entity, foxglove::LinePrimitive::LINE_LIST, map_color);
  for (const msg::MapLine& line : message.lines()) {
    Scene::add_point(walls, line.start().x(), line.start().y());
    Scene::add_point(walls, line.end().x(), line.end().y());
  }
  return true;
}

bool show_status(const msg::ServiceStatus& message, foxglove::Log& out) {
  using enum msg::ServiceState;
  const msg::ServiceState state = message.state();
  std::string text;
  foxglove::Log::Level level = foxglove::Log::INFO;
  if (state == STATE_ACTIVE) {
    if (message.detail().empty()) return false;
    level = foxglove::Log::WARNING;
  } else {
    text = state == STATE_FAILED     ? "failed"
           : state == STATE_STOPPED  ? "stopped"
           : state == STATE_FINISHED ? "finished"
                                     : "starting";
    if (state == STATE_FAILED) level = foxglove::Log::ERROR;
  }
  if (!message.detail().empty()) text += (text.empty() ? "" : ": ") + message.detail();
  set_time(message.stamp(), *out.mutable_timestamp());
  out.set_level(level);
  out.set_name(message.service());
  out.set_message(text);
  return true;
}

}  // namespace quoin::topics
