// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/scene.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace quoin::topics {

namespace {

constexpr int ellipse_points = 32;
constexpr double line_width = 2.0;  // [pixel]
constexpr double text_size = 12.0;  // [pixel]

void set_color(const SceneColor& color, foxglove::Color& out) {
  out.set_r(color.r);
  out.set_g(color.g);
  out.set_b(color.b);
  out.set_a(color.a);
}

}  // namespace

void set_time(std::int64_t stamp, google::protobuf::Timestamp& time) {
  constexpr std::int64_t second = 1'000'000'000;
  std::int64_t seconds = stamp / second;
  std::int64_t rest = stamp % second;
  if (rest < 0) {
    --seconds;
    rest += second;
  }
  time.set_seconds(seconds);
  time.set_nanos(static_cast<std::int32_t>(rest));
}

void set_heading(double theta, foxglove::Quaternion& rotation) {
  rotation.set_z(std::sin(0.5 * theta));
  rotation.set_w(std::cos(0.5 * theta));
}

void set_pose(const Pose2& pose, foxglove::Pose& out) {
  out.mutable_position()->set_x(pose.x);
  out.mutable_position()->set_y(pose.y);
  set_heading(pose.theta, *out.mutable_orientation());
}

void set_transform(std::string_view parent, std::string_view child, std::int64_t stamp,
                   const Pose2& pose, foxglove::FrameTransform& out) {
  set_time(stamp, *out.mutable_timestamp());
  out.set_parent_frame_id(std::string(parent));
  out.set_child_frame_id(std::string(child));
  out.mutable_translation()->set_x(pose.x);
  out.mutable_translation()->set_y(pose.y);
  set_heading(pose.theta, *out.mutable_rotation());
}

Scene::Scene(const msg::Header& header, foxglove::SceneUpdate& update)
    : header_(header), update_(update) {
  foxglove::SceneEntityDeletion& deletion = *update.add_deletions();
  set_time(header.stamp(), *deletion.mutable_timestamp());
  deletion.set_type(foxglove::SceneEntityDeletion::ALL);
}

foxglove::SceneEntity& Scene::add(const std::string& name) {
  const int number = update_.entities_size();
  foxglove::SceneEntity& entity = *update_.add_entities();
  set_time(header_.stamp(), *entity.mutable_timestamp());
  entity.set_frame_id(header_.frame());
  entity.set_id(name + ' ' + std::to_string(number));
  return entity;
}

void Scene::describe(foxglove::SceneEntity& entity, const std::string& name, double value,
                     const std::string& unit) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  foxglove::KeyValuePair& pair = *entity.add_metadata();
  pair.set_key(name);
  pair.set_value(unit.empty() ? std::string(text.data()) : text.data() + (' ' + unit));
}

foxglove::LinePrimitive& Scene::add_line(foxglove::SceneEntity& entity,
                                         foxglove::LinePrimitive::Type type,
                                         const SceneColor& color) {
  foxglove::LinePrimitive& line = *entity.add_lines();
  line.set_type(type);
  set_pose({}, *line.mutable_pose());
  line.set_thickness(line_width);
  line.set_scale_invariant(true);
  set_color(color, *line.mutable_color());
  return line;
}

void Scene::add_point(foxglove::LinePrimitive& line, double x, double y) {
  foxglove::Point3& point = *line.add_points();
  point.set_x(x);
  point.set_y(y);
}

void Scene::add_ellipse(foxglove::SceneEntity& entity, double x, double y, const Ellipse& ellipse,
                        const SceneColor& color) {
  foxglove::LinePrimitive& line = add_line(entity, foxglove::LinePrimitive::LINE_LOOP, color);
  const Pose2 pose{x, y, ellipse.direction};
  for (int i = 0; i < ellipse_points; ++i) {
    const double t = 2.0 * std::numbers::pi * i / ellipse_points;
    const Eigen::Vector2d point =
        pose.transform({ellipse.semi_major * std::cos(t), ellipse.semi_minor * std::sin(t)});
    add_point(line, point.x(), point.y());
  }
}

void Scene::add_text(foxglove::SceneEntity& entity, double x, double y, const std::string& text,
                     const SceneColor& color) {
  foxglove::TextPrimitive& out = *entity.add_texts();
  set_pose({x, y, 0.0}, *out.mutable_pose());
  out.set_billboard(true);
  out.set_font_size(text_size);
  out.set_scale_invariant(true);
  set_color(color, *out.mutable_color());
  out.set_text(text);
}

}  // namespace quoin::topics
