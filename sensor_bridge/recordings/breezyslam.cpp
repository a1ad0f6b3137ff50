// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/breezyslam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/mapping/motion.hpp"
#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge {
namespace {

constexpr std::size_t columns_before_ranges = 24;
constexpr double metres_per_count = 2.0 * std::numbers::pi * 0.077 / 2000.0;
constexpr double track_width = 0.33;  // [m]
// URG-04LX: 1024 steps a turn, the first range at step 44, straight ahead at 384, one each 100 ms
// (its communication protocol).
constexpr double bearing_step = 2.0 * std::numbers::pi / 1024.0;
constexpr double first_bearing = (44 - 384) * bearing_step;
constexpr std::size_t ranges_of_a_scan = 682;
constexpr double step_time = 0.1 / 1024.0;  // [s]

}  // namespace

bool BreezySlamScans::operator()(LineReader& lines, RecordedScan& scan) {
  constexpr std::string_view blank = " \t";
  std::string_view line;
  do {
    if (!lines.next(line)) return false;
  } while (line.find_first_not_of(blank) == std::string_view::npos);
  scan.clear();
  std::array<double, columns_before_ranges> columns{};
  std::size_t count = 0;
  for (std::size_t at = line.find_first_not_of(blank); at < line.size(); ++count) {
    const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
    const std::string_view word = line.substr(at, end - at);
    const std::optional<double> value = parse_number<double>(word);
    if (!value || !std::isfinite(*value)) lines.fail(at, excerpt(word) + " is not a number");
    if (count < columns_before_ranges) {
      columns[count] = *value;
    } else if (scan.ranges.size() < ranges_of_a_scan) {
      const auto step = static_cast<double>(scan.ranges.size());
      scan.ranges.push_back(static_cast<float>(*value * 1e-3));
      scan.bearings.push_back(static_cast<float>(first_bearing + step * bearing_step));
      scan.time_offsets.push_back(static_cast<float>(step * step_time));
    }
    at = std::min(line.find_first_not_of(blank, end), line.size());
  }
  if (scan.ranges.size() < ranges_of_a_scan) {
    lines.fail(line.size(), "the line ends after " + std::to_string(count) + " numbers; " +
                                std::to_string(columns_before_ranges) + " and " +
                                std::to_string(ranges_of_a_scan) +
                                " ranges are expected; the file is cut off or of another format");
  }
  scan.stamp = columns[0] * 1e-6;
  if (!first_) {
    const double left = (columns[2] - left_) * metres_per_count;
    const double right = (columns[3] - right_) * metres_per_count;
    pose_ =
        compose(pose_, after_twist({0.5 * (left + right), 0.0, (right - left) / track_width}, 1.0));
  }
  first_ = false;
  left_ = columns[2];
  right_ = columns[3];
  scan.odometry.push_back({std::nullopt, pose_});
  return true;
}

}  // namespace quoin::sensor_bridge
