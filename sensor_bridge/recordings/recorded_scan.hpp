// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/pose.hpp"

namespace quoin::sensor_bridge {

/// A scan as a file holds it. Bearings and ranges have the same length.
struct RecordedScan {
  /// More rays than any 2D LiDAR has: a larger count in a file is damage.
  static constexpr std::size_t max_points = 100000;

  std::optional<double> stamp;    ///< [s] by the clock of the recording, of unknown epoch
  std::vector<float> bearings;    ///< [rad] counter-clockwise from x
  std::vector<float> ranges;      ///< [m] as recorded; may be NaN or infinite
  std::optional<Pose2> pose;      ///< of the laser, as the recording has it
  std::optional<Pose2> odometry;  ///< of the robot
  bool first_of_file = false;     ///< stamps before this scan belong to another recording

  /// Empties the scan and keeps its memory.
  void clear();
};

/// Rewrites ranges by REP-117: `range_max` and more is no return (+inf), what is positive but below
/// `range_min` too close (-inf), zero and negative invalid (NaN).
void apply_range_limits(double range_min, double range_max, std::vector<float>& ranges);

}  // namespace quoin::sensor_bridge
