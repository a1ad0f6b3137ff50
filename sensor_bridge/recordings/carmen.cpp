// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/carmen.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge {
namespace {

constexpr std::string_view blank = " \t";

// CARMEN logger: FLASER n r_1 .. r_n x y theta odom_x odom_y odom_theta ipc_timestamp ipc_hostname
// logger_timestamp.
constexpr std::size_t poses_and_stamps = 9;

/// Words of one line, with their positions for messages.
class Words {
 public:
  Words(const LineReader& lines, std::string_view line) : lines_(lines), line_(line) {}

  /// False at the end of the line.
  bool next(std::string_view& word) {
    offset_ = std::min(line_.find_first_not_of(blank, end_), line_.size());
    end_ = std::min(line_.find_first_of(blank, offset_), line_.size());
    word = line_.substr(offset_, end_ - offset_);
    return !word.empty();
  }

  /// The next word as a number; NaN and infinity count.
  double number(std::size_t ranges, std::size_t values_read) {
    std::string_view word;
    if (!next(word)) {
      fail("FLASER announces " + std::to_string(ranges) + " ranges and " +
           std::to_string(poses_and_stamps) + " values after them, but the line ends after " +
           std::to_string(values_read) + " of these " + std::to_string(ranges + poses_and_stamps) +
           "; the file is cut off or damaged here");
    }
    const std::optional<double> value = parse_number<double>(word);
    if (!value) fail(excerpt(word) + " is not a number");
    return *value;
  }

  [[noreturn]] void fail(const std::string& what) const { lines_.fail(offset_, what); }

 private:
  const LineReader& lines_;
  std::string_view line_;
  std::size_t offset_ = 0;  // of the word last read
  std::size_t end_ = 0;     // behind it
};

std::size_t range_count(Words& words) {
  std::string_view word;
  if (!words.next(word)) words.fail("FLASER without a number of ranges; the file is cut off here");
  const std::optional<std::size_t> count = parse_number<std::size_t>(word);
  if (!count) words.fail(excerpt(word) + " is not a number of ranges");
  if (*count == 0 || *count > RecordedScan::max_points) {
    words.fail("FLASER announces " + std::to_string(*count) + " ranges; 1 to " +
               std::to_string(RecordedScan::max_points) + " are possible");
  }
  return *count;
}

std::optional<Pose2> finite(const Pose2& pose) {
  if (std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta)) return pose;
  return std::nullopt;
}

void parse_flaser(Words& words, double field_of_view, RecordedScan& scan) {
  scan.clear();
  const std::size_t count = range_count(words);
  for (std::size_t i = 0; i < count; ++i) {
    scan.ranges.push_back(static_cast<float>(words.number(count, i)));
  }
  fill_bearings(count, field_of_view, scan.bearings);
  double values[7] = {};
  for (std::size_t i = 0; i < 7; ++i) values[i] = words.number(count, count + i);
  scan.pose = finite({values[0], values[1], values[2]});
  if (const auto odometry = finite({values[3], values[4], values[5]})) {
    scan.odometry.push_back({std::nullopt, *odometry});
  }
  if (std::isfinite(values[6])) scan.stamp = values[6];

  std::string_view host;
  if (!words.next(host)) static_cast<void>(words.number(count, count + 7));  // says what is missing
  static_cast<void>(words.number(count, count + 8));
  std::string_view surplus;
  if (words.next(surplus)) {
    words.fail(excerpt(surplus) + " is one value too many for a FLASER line of " +
               std::to_string(count) + " ranges; is their number right?");
  }
}

}  // namespace

void fill_bearings(std::size_t count, double field_of_view, std::vector<float>& bearings) {
  const std::size_t steps = count % 2 == 0 || count == 1 ? count : count - 1;
  const double step = field_of_view / static_cast<double>(steps);
  bearings.clear();
  for (std::size_t i = 0; i < count; ++i) {
    bearings.push_back(static_cast<float>(-0.5 * field_of_view + static_cast<double>(i) * step));
  }
}

bool read_carmen_scan(LineReader& lines, double field_of_view, RecordedScan& scan) {
  std::string_view line;
  while (lines.next(line)) {
    Words words(lines, line);
    std::string_view message;
    if (words.next(message) && message == "FLASER") {
      parse_flaser(words, field_of_view, scan);
      return true;
    }
  }
  return false;
}

}  // namespace quoin::sensor_bridge
