// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Scan.h>
#include <span>
#include <vector>

#include "core/mapping/motion.hpp"
#include "services/deskewing/parameters.hpp"
#include "services/topics/poses.hpp"

namespace quoin {

/// Stamp [ns] of the last ray of a scan. `sweep` [s]: of one that does not say when its rays were
/// cast.
[[nodiscard]] inline std::int64_t last_ray(const msg::Scan& scan, double sweep) {
  double last = scan.duration();
  for (const float offset : scan.time_offsets()) last = std::max(last, double{offset});
  if (scan.time_offsets().empty() && !(last > 0.0)) last = sweep;
  return scan.header().stamp() + static_cast<std::int64_t>(std::clamp(last, 0.0, 100.0) * 1e9);
}

/// Rewrites the rays of a scan as if all were cast with the first one.
class ScanMotion {
 public:
  explicit ScanMotion(const DeskewingParameters& parameters)
      : sweep_(parameters.sweep),
        mounting_{parameters.mounting_x, parameters.mounting_y, parameters.mounting_yaw} {}

  /// `Messages` are of odometry or poses, in the order of their stamps. False, with the scan as it
  /// was, when they do not reach from its first to its last ray.
  template <class Message>
  bool remove(std::span<const Message* const> messages, msg::Scan& scan) {
    OdometryTrack track;
    const std::int64_t first = scan.header().stamp();
    for (const Message* message : messages) {
      if (!topics::valid(message->pose())) return false;
      const PoseEstimate robot = topics::pose_estimate(message->pose());
      (void)track.add(static_cast<double>(message->header().stamp() - first) * 1e-9,
                      compose(robot.pose, mounting_));
    }
    fill_offsets(scan);
    if (!deskew(track, 0.0, offsets_, scan.bearings(), scan.ranges())) return false;
    scan.time_offsets().clear();
    scan.duration(0.0F);
    return true;
  }

 private:
  void fill_offsets(const msg::Scan& scan) {
    const std::size_t count = scan.ranges().size();
    if (scan.time_offsets().size() == count) {
      offsets_.assign(scan.time_offsets().begin(), scan.time_offsets().end());
      return;
    }
    const double sweep = scan.duration() > 0.0F ? double{scan.duration()} : sweep_;
    const double steps = count > 1 ? static_cast<double>(count - 1) : 1.0;
    offsets_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      offsets_.push_back(static_cast<float>(sweep * static_cast<double>(i) / steps));
    }
  }

  double sweep_;
  Pose2 mounting_;
  std::vector<float> offsets_;
};

}  // namespace quoin
