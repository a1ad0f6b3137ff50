// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <idl/LineMap.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Segments.h>
#include <memory>
#include <string>
#include <vector>

#include "core/mapping/motion.hpp"
#include "services/localization/localizer_method.hpp"
#include "services/topics/lines.hpp"
#include "services/topics/poses.hpp"
#include "tests/services/runtime/node/stage.hpp"

namespace quoin {

/// Walls of a room with a niche, as a sensor at `pose` sees them: exact, with a small covariance.
inline void see_room(const Pose2& pose, msg::Lines& out) {
  const std::vector<Eigen::Vector2d> corners{{-2.0, -1.5}, {4.0, -1.5}, {4.0, 2.0}, {1.0, 2.0},
                                             {1.0, 1.2},   {0.4, 1.2},  {0.4, 2.0}, {-2.0, 2.0}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    LineSegment line;
    line.start = pose.inverse_transform(corners[i]);
    line.end = pose.inverse_transform(corners[(i + 1) % corners.size()]);
    const Eigen::Vector2d along = (line.end - line.start).normalized();
    const Eigen::Vector2d normal(along.y(), -along.x());
    line.estimate.line = {std::atan2(normal.y(), normal.x()), normal.dot(line.start)};
    line.estimate.covariance << 1e-6, 0.0, 0.0, 1e-6;
    line.estimate = normalized(line.estimate);
    line.points = 100;
    topics::append_line(line, 98.0, static_cast<std::uint32_t>(i), out);
  }
}

/// A node of kind mapping or localization in memory, fed with what a robot in the room sees.
class RoomDrive {
 public:
  RoomDrive(MakeInFolder make, const std::string& method, const ParameterSettings& settings,
            const std::filesystem::path& folder = "/nowhere")
      : stage_(
            {.service = "slam", .method = method, .parameters = settings},
            [make, folder](const std::string& name, const ParameterSettings& parameters) {
              return make(name, parameters, folder);
            },
            runtime::outputs(runtime::output_part(poses_),
                             runtime::output_part(map_, Rate::own_rate))) {
    stage_.node().open(runtime::inputs(
        runtime::input_part({"lines", "lines"}, "fitter", lines_),
        runtime::input_part({"odometry", "odometry", Join::by_time, false}, "wheels", odometry_)));
  }

  /// Odometry at `stamp` [ms]: the robot is here by its wheels.
  void drive(std::int64_t stamp, const Pose2& pose) {
    msg::Odometry message = wheels_.next_at(stamp * runtime::millisecond);
    message.header().frame("odom");
    message.pose(topics::pose_message({pose, Eigen::Matrix3d::Zero()}));
    odometry_->push(message);
  }
  /// The scan at `stamp` [ms], of a sensor that is here; the pose that comes of it.
  const msg::Pose& scan(std::int64_t stamp, const Pose2& sensor) {
    msg::Lines message = fitter_.next_at(stamp * runtime::millisecond);
    see_room(sensor, message);
    return publish(message);
  }
  const msg::Pose& publish(const msg::Lines& message) {
    lines_->push(message);
    stage_.run();
    stage_.clock().advance(std::chrono::milliseconds(300));
    stage_.run();
    return poses_->written.at(poses_->written.size() - 1);
  }

  [[nodiscard]] std::string diagnostic(const std::string& name) {
    const msg::ServiceStatus status = stage_.status();
    for (const msg::Diagnostic& entry : status.diagnostics()) {
      if (entry.name() == name) return entry.value();
    }
    return "";
  }

  runtime::Numbered<msg::Lines> fitter_{"front"};
  runtime::Numbered<msg::Odometry> wheels_{"wheels"};
  std::shared_ptr<runtime::MemoryQueue<msg::Lines>> lines_ =
      std::make_shared<runtime::MemoryQueue<msg::Lines>>();
  std::shared_ptr<runtime::MemoryQueue<msg::Odometry>> odometry_ =
      std::make_shared<runtime::MemoryQueue<msg::Odometry>>();
  std::shared_ptr<runtime::MemoryTopic<msg::Pose>> poses_ =
      std::make_shared<runtime::MemoryTopic<msg::Pose>>();
  std::shared_ptr<runtime::MemoryTopic<msg::LineMap>> map_ =
      std::make_shared<runtime::MemoryTopic<msg::LineMap>>();
  runtime::Stage stage_;
};

}  // namespace quoin
