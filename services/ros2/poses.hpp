// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/geometry/pose.hpp"
#include "core/mapping/motion.hpp"
#include "services/ros2/messages.hpp"

namespace quoin::ros2 {

// Messages of ROS 2 have three dimensions: of height, roll and pitch all variances are 0, as those
// of other localizers in the plane are.

void fill_pose(const msg::Pose& in, PoseWithCovarianceStamped& out);
void fill_odometry(const msg::Odometry& in, Odometry& out);

/// `pose` of `child` in `parent`, at `stamp` [ns].
[[nodiscard]] TransformStamped transform(std::int64_t stamp, std::string_view parent,
                                         std::string_view child, const Pose2& pose,
                                         double height = 0.0);

/// The transform from map to odom (REP-105): what odometry has drifted by, from poses in the map
/// and the odometry at their stamps.
class MapToOdom {
 public:
  /// Odometry at its stamp. Gives the transform of a pose that waited for it.
  [[nodiscard]] std::optional<TransformStamped> add(const msg::Odometry& odometry);
  /// A pose; nothing while the odometry of its stamp is missing: the newest pose waits for that.
  /// Nothing for one that is lost, or of another frame than that of the odometry.
  [[nodiscard]] std::optional<TransformStamped> add(const msg::Pose& pose);

  /// Poses without a transform because they are of another frame than the odometry.
  [[nodiscard]] std::uint64_t other_frames() const { return other_frames_; }

 private:
  [[nodiscard]] std::optional<TransformStamped> resolve();

  OdometryTrack track_;
  std::string odom_frame_;
  std::string child_frame_;
  std::optional<msg::Pose> waiting_;
  std::uint64_t other_frames_ = 0;
};

/// What is wrong with a nav_msgs/Odometry.
enum class OdometryFault {
  not_finite,
  no_rotation,
  tilted,
  no_frames,
  stamp_zero,
  stamp_not_later
};
inline constexpr std::size_t odometry_fault_count = 6;
[[nodiscard]] std::string_view text_of(OdometryFault fault);

/// Turns nav_msgs/Odometry into odometry in the plane, and counts what is wrong with it.
class OdometryImport {
 public:
  /// False when it cannot be used. `received` [ns since the Unix epoch] is when it came.
  [[nodiscard]] bool convert(const Odometry& in, std::int64_t received, msg::Odometry& out);
  [[nodiscard]] std::uint64_t count(OdometryFault fault) const {
    const auto found = counts_.find(fault);
    return found == counts_.end() ? 0 : found->second;
  }
  [[nodiscard]] std::uint64_t faults() const { return faults_; }

 private:
  void note(OdometryFault fault);

  std::map<OdometryFault, std::uint64_t> counts_;
  std::uint64_t faults_ = 0;
  std::int64_t stamp_ = 0;
};

}  // namespace quoin::ros2
