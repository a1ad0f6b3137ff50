// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/pose.hpp"
#include "core/sensor/points.hpp"

namespace quoin::sensor_bridge {

/// Where the robot was by its wheels.
struct RecordedOdometry {
  std::optional<double> stamp =
      {};           ///< [s] by the clock of the recording; nothing: that of the scan
  Pose2 pose = {};  ///< in a frame that does not move
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y, theta; zero: not known
  std::optional<Eigen::Vector3d> velocity =
      {};  ///< [m/s, m/s, rad/s] of the robot in its own frame
  std::optional<std::int64_t> epoch_stamp = {};  ///< [ns since the Unix epoch] where it is exact
  std::string frame = {};                        ///< "" when the recording has none
  std::string child_frame = {};
};

/// A scan as a file holds it. Bearings and ranges have the same length.
struct RecordedScan {
  /// More rays than any 2D LiDAR has: a larger count in a file is damage.
  static constexpr std::size_t max_points = 100000;

  std::optional<double> stamp;  ///< [s] by the clock of the recording, of unknown epoch
  std::optional<std::int64_t>
      epoch_stamp;                  ///< [ns since the Unix epoch] the same, where it is exact
  std::vector<float> bearings;      ///< [rad] counter-clockwise from x
  std::vector<float> ranges;        ///< [m] as recorded; may be NaN or infinite
  std::vector<float> time_offsets;  ///< [s] of each ray after `stamp`, or none
  std::vector<float> qualities;     ///< of each ray, by the measure of the file, or none
  std::optional<double> duration;   ///< [s] from the first to the last ray
  std::optional<double> range_min;  ///< [m] as the recording has it
  std::optional<double> range_max;  ///< [m] likewise: a longer range is no return
  std::string frame;                ///< "" when the recording has none
  /// Of a scan of ours, whose ranges are as they should be.
  std::optional<SensorModel> sensor;
  bool sensor_estimated = false;
  std::optional<Pose2> pose;  ///< of the laser, as the recording has it
  /// Since the scan before, in the order of the file.
  std::vector<RecordedOdometry> odometry;
  bool first_of_file = false;      ///< stamps before this scan belong to another recording
  std::vector<std::string> notes;  ///< what was guessed or passed over on the way to it, for people

  /// Empties the scan and keeps its memory.
  void clear();
};

/// Rewrites ranges by REP-117: `range_max` and more is no return (+inf), what is positive but below
/// `range_min` too close (-inf), zero and negative invalid (NaN).
void apply_range_limits(double range_min, double range_max, std::vector<float>& ranges);

}  // namespace quoin::sensor_bridge
