// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/recorded_scan.hpp"

#include <limits>

namespace quoin::sensor_bridge {

void RecordedScan::clear() {
  stamp.reset();
  epoch_stamp.reset();
  bearings.clear();
  ranges.clear();
  time_offsets.clear();
  qualities.clear();
  duration.reset();
  range_min.reset();
  range_max.reset();
  frame.clear();
  sensor.reset();
  sensor_estimated = false;
  pose.reset();
  odometry.clear();
  first_of_file = false;
  notes.clear();
}

void apply_range_limits(double range_min, double range_max, std::vector<float>& ranges) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto shortest = static_cast<float>(range_min);
  const auto longest = static_cast<float>(range_max);
  for (float& range : ranges) {
    if (range >= longest) {
      range = infinity;
    } else if (range == -infinity) {
      continue;  // already marked as too close
    } else if (range <= 0.0F) {
      range = std::numeric_limits<float>::quiet_NaN();
    } else if (range < shortest) {
      range = -infinity;
    }
  }
}

}  // namespace quoin::sensor_bridge
