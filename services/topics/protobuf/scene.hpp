// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <foxglove/foxglove.pb.h>
#include <idl/Common.h>
#include <string>
#include <string_view>

#include "core/geometry/corner.hpp"
#include "core/geometry/pose.hpp"

namespace quoin::topics {

/// `stamp` [ns since the Unix epoch].
void set_time(std::int64_t stamp, google::protobuf::Timestamp& time);
/// `theta` [rad] about z.
void set_heading(double theta, foxglove::Quaternion& rotation);
void set_pose(const Pose2& pose, foxglove::Pose& out);

/// Where `child` stands in `parent`.
void set_transform(std::string_view parent, std::string_view child, std::int64_t stamp,
                   const Pose2& pose, foxglove::FrameTransform& out);

struct SceneColor {
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;
  double a = 1.0;
};

/// A picture of one message: what the message before it on the topic showed goes, entities come.
class Scene {
 public:
  Scene(const msg::Header& header, foxglove::SceneUpdate& update);

  /// A thing that can be clicked on; its id is `name` and its number among those of that name.
  foxglove::SceneEntity& add(const std::string& name);
  /// A value that the viewer shows of an entity: "0.0123 m".
  static void describe(foxglove::SceneEntity& entity, const std::string& name, double value,
                       const std::string& unit = "");
  /// A line of `points`, as wide on the screen at any distance.
  static foxglove::LinePrimitive& add_line(foxglove::SceneEntity& entity,
                                           foxglove::LinePrimitive::Type type,
                                           const SceneColor& color);
  static void add_point(foxglove::LinePrimitive& line, double x, double y);
  /// The outline of an ellipse about (x, y).
  static void add_ellipse(foxglove::SceneEntity& entity, double x, double y, const Ellipse& ellipse,
                          const SceneColor& color);
  /// A text that faces the viewer.
  static void add_text(foxglove::SceneEntity& entity, double x, double y, const std::string& text,
                       const SceneColor& color);

 private:
  const msg::Header& header_;
  foxglove::SceneUpdate& update_;
};

}  // namespace quoin::topics
