// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/views.hpp"

#include <algorithm>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/LineMap.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <idl/Status.h>

#include "services/topics/cdr_codec.hpp"
#include "services/topics/protobuf/feature_views.hpp"
#include "services/topics/protobuf/pose_views.hpp"
#include "services/topics/protobuf/scan_views.hpp"
#include "services/topics/protobuf/scene.hpp"

namespace quoin::topics {

namespace {

struct Row {
  std::string_view type;
  const CdrCodec& (*codec)();
  std::span<const View> views;
};

/// A view made by a function that fills a Foxglove message of one of ours.
template <class T, class Shown, bool (*fill)(const T&, Shown&)>
bool append(const void* message, std::string& out) {
  // Kept for its memory.
  thread_local Shown shown;
  shown.Clear();
  return fill(*static_cast<const T*>(message), shown) && shown.AppendToString(&out);
}

constexpr View scan_views[] = {
    {"laser_scan", "foxglove.LaserScan", append<msg::Scan, foxglove::LaserScan, show_rays>},
    {"points", "foxglove.PointCloud", append<msg::Scan, foxglove::PointCloud, show_points>}};
constexpr View segments_views[] = {
    {"points", "foxglove.PointCloud", append<msg::Segments, foxglove::PointCloud, show_segments>}};
constexpr View lines_views[] = {
    {"scene", "foxglove.SceneUpdate", append<msg::Lines, foxglove::SceneUpdate, show_lines>}};
constexpr View corners_views[] = {
    {"scene", "foxglove.SceneUpdate", append<msg::Corners, foxglove::SceneUpdate, show_corners>}};
constexpr View circles_views[] = {
    {"scene", "foxglove.SceneUpdate", append<msg::Circles, foxglove::SceneUpdate, show_circles>}};

constexpr View odometry_views[] = {
    {"pose", "foxglove.PoseInFrame", append<msg::Odometry, foxglove::PoseInFrame, show_odometry>},
    {"tf", "foxglove.FrameTransform",
     append<msg::Odometry, foxglove::FrameTransform, show_odometry_frame>}};
constexpr View pose_views[] = {
    {"pose", "foxglove.PoseInFrame", append<msg::Pose, foxglove::PoseInFrame, show_pose>},
    {"tf", "foxglove.FrameTransform", append<msg::Pose, foxglove::FrameTransform, show_pose_frame>},
    {"scene", "foxglove.SceneUpdate", append<msg::Pose, foxglove::SceneUpdate, show_pose_ellipse>}};
constexpr View line_map_views[] = {
    {"scene", "foxglove.SceneUpdate", append<msg::LineMap, foxglove::SceneUpdate, show_line_map>}};

constexpr View status_views[] = {
    {"log", "foxglove.Log", append<msg::ServiceStatus, foxglove::Log, show_status>}};

constexpr Row table[] = {{"scan", cdr_codec<msg::Scan>, scan_views},
                         {"segments", cdr_codec<msg::Segments>, segments_views},
                         {"lines", cdr_codec<msg::Lines>, lines_views},
                         {"corners", cdr_codec<msg::Corners>, corners_views},
                         {"circles", cdr_codec<msg::Circles>, circles_views},
                         {"odometry", cdr_codec<msg::Odometry>, odometry_views},
                         {"pose", cdr_codec<msg::Pose>, pose_views},
                         {"line_map", cdr_codec<msg::LineMap>, line_map_views},
                         {"status", cdr_codec<msg::ServiceStatus>, status_views}};

}  // namespace

struct Views::Message {
  const CdrCodec& codec;
  void* message;

  explicit Message(const CdrCodec& made_by) : codec(made_by), message(codec.create()) {}
  ~Message() { codec.destroy(message); }
  Message(const Message&) = delete;
  Message& operator=(const Message&) = delete;
};

Views::Views(std::string_view type) {
  const auto* row = std::ranges::find(table, type, &Row::type);
  if (row == std::end(table)) return;
  views_ = row->views;
  message_ = std::make_unique<Message>(row->codec());
}

Views::~Views() = default;
Views::Views(Views&&) noexcept = default;
Views& Views::operator=(Views&&) noexcept = default;

bool Views::read(std::span<const std::byte> cdr) {
  return message_ != nullptr && decode(message_->codec, cdr.data(), cdr.size(), message_->message);
}

bool Views::append(std::size_t view, std::string& out) const {
  return views_[view].append(message_->message, out);
}

std::string frame_transform(std::string_view parent, std::string_view child, std::int64_t stamp,
                            const Pose2& pose) {
  foxglove::FrameTransform transform;
  set_transform(parent, child, stamp, pose, transform);
  return transform.SerializeAsString();
}

}  // namespace quoin::topics
