// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <foxglove/foxglove.pb.h>
#include <idl/LineMap.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Status.h>

namespace quoin::topics {

bool show_odometry(const msg::Odometry& message, foxglove::PoseInFrame& out);
bool show_odometry_frame(const msg::Odometry& message, foxglove::FrameTransform& out);
bool show_pose(const msg::Pose& message, foxglove::PoseInFrame& out);
/// Where the robot is. Not while it is lost.
bool show_pose_frame(const msg::Pose& message, foxglove::FrameTransform& out);
/// The 95 % ellipse of the position.
bool show_pose_ellipse(const msg::Pose& message, foxglove::SceneUpdate& out);
/// The walls of a part of the map, which take the place of those that the part had before.
bool show_line_map(const msg::LineMap& message, foxglove::SceneUpdate& out);

/// What a service says of itself in its heartbeat. Nothing while all is well.
bool show_status(const msg::ServiceStatus& message, foxglove::Log& out);

}  // namespace quoin::topics
