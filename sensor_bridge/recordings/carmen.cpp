// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/carmen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge {
namespace {

constexpr std::string_view blank = " \t";

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

  /// How errors call the line: FLASER, and how many ranges it announces.
  void begin(std::string_view name) { name_ = name; }
  void announce(std::size_t ranges) { announced_ = ranges; }

  /// The next word as a number; NaN and infinity count.
  double number() {
    std::string_view word;
    if (!next(word)) {
      fail(name_ +
           (announced_ ? " announces " + std::to_string(*announced_) + " ranges, but the"
                       : ": the") +
           " line ends early; the file is cut off or damaged here");
    }
    const std::optional<double> value = parse_number<double>(word);
    if (!value) fail(excerpt(word) + " is not a number");
    return *value;
  }

  std::size_t count(const char* what, std::size_t most) {
    std::string_view word;
    if (!next(word)) {
      fail(name_ + " without a number of " + what + "; the file is cut off here");
    }
    const std::optional<std::size_t> count = parse_number<std::size_t>(word);
    if (!count) fail(excerpt(word) + " is not a number of " + what);
    if (*count > most) {
      fail(name_ + " announces " + std::to_string(*count) + " " + what + "; at most " +
           std::to_string(most) + " are possible");
    }
    return *count;
  }

  void finish() {
    std::string_view surplus;
    if (next(surplus)) {
      fail(excerpt(surplus) + " is one value too many for a " + name_ + " line" +
           (announced_ ? " of " + std::to_string(*announced_) + " ranges; is their number right?"
                       : ""));
    }
  }

  [[noreturn]] void fail(const std::string& what) const { lines_.fail(offset_, what); }

 private:
  const LineReader& lines_;
  std::string_view line_;
  std::string name_;
  std::optional<std::size_t> announced_;
  std::size_t offset_ = 0;  // of the word last read
  std::size_t end_ = 0;     // behind it
};

std::optional<Pose2> finite(const Pose2& pose) {
  if (std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta)) return pose;
  return std::nullopt;
}

Pose2 read_pose(Words& words) {
  const double x = words.number();
  const double y = words.number();
  return {x, y, words.number()};
}

void read_ranges(Words& words, RecordedScan& scan) {
  const std::size_t count = words.count("ranges", RecordedScan::max_points);
  words.announce(count);
  for (std::size_t i = 0; i < count; ++i) {
    scan.ranges.push_back(static_cast<float>(words.number()));
  }
}

/// ipc_timestamp ipc_hostname logger_timestamp
void read_stamps(Words& words, RecordedScan& scan) {
  const double stamp = words.number();
  if (std::isfinite(stamp)) scan.stamp = stamp;
  std::string_view host;
  if (!words.next(host)) (void)words.number();  // says what is missing
  (void)words.number();
  words.finish();
}

// CARMEN logger, logger/readlog.c of its sources, all lines begin with their name.
// FLASER n r_1 .. r_n x y theta odom_x odom_y odom_theta ipc_timestamp ipc_hostname
// logger_timestamp
std::string parse_flaser(Words& words, const ScanGeometry& geometry, RecordedScan& scan) {
  read_ranges(words, scan);
  std::string note = fill_bearings(scan.ranges.size(), geometry, scan.bearings);
  scan.pose = finite(read_pose(words));
  if (const auto odometry = finite(read_pose(words))) {
    scan.odometry.push_back({std::nullopt, *odometry});
  }
  read_stamps(words, scan);
  return note;
}

// RAWLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy
// remission_mode n r_1 .. r_n m remission_1 .. remission_m ipc_timestamp ipc_hostname
// logger_timestamp
// ROBOTLASER1 has, before the stamps: laser_pose (x y theta) robot_pose (x y theta) tv rv
// forward_safety_dist side_safety_dist turn_axis
void parse_laser(Words& words, bool of_robot, RecordedScan& scan) {
  (void)words.number();  // type
  const double start = words.number();
  const double field_of_view = words.number();
  double step = words.number();
  const double longest = words.number();
  (void)words.number();  // accuracy
  (void)words.number();  // remission mode
  read_ranges(words, scan);
  const auto rays = static_cast<double>(scan.ranges.size());
  if (!std::isfinite(start) || !std::isfinite(field_of_view)) words.fail("no finite start angle");
  if (!(step > 0.0) && rays > 1.0) step = field_of_view / (rays - 1.0);  // some wrote 0
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    scan.bearings.push_back(static_cast<float>(start + static_cast<double>(i) * step));
  }
  if (longest > 0.0 && std::isfinite(longest)) scan.range_max = longest;
  const std::size_t remissions = words.count("remission values", RecordedScan::max_points);
  for (std::size_t i = 0; i < remissions; ++i) (void)words.number();
  if (of_robot) {
    scan.pose = finite(read_pose(words));
    if (const auto odometry = finite(read_pose(words))) {
      scan.odometry.push_back({std::nullopt, *odometry});
    }
    for (int i = 0; i < 5; ++i) (void)words.number();
  }
  read_stamps(words, scan);
}

// ODOM x y theta tv rv acceleration ipc_timestamp ipc_hostname logger_timestamp
std::optional<RecordedOdometry> parse_odometry(Words& words) {
  const auto pose = finite(read_pose(words));
  const double forward = words.number();
  const double turning = words.number();
  (void)words.number();  // acceleration
  RecordedScan stamps;
  read_stamps(words, stamps);
  if (!pose || !stamps.stamp) return std::nullopt;
  RecordedOdometry odometry{.stamp = stamps.stamp, .pose = *pose};
  if (std::isfinite(forward) && std::isfinite(turning)) {
    odometry.velocity = Eigen::Vector3d(forward, 0.0, turning);
  }
  return odometry;
}

}  // namespace

bool CarmenScans::operator()(LineReader& lines, RecordedScan& scan) {
  std::vector<RecordedOdometry> between;
  std::string note;
  const auto add_odometry_between = [&] {
    const bool own = !scan.odometry.empty();
    std::erase_if(between, [&](const RecordedOdometry& odometry) {
      return own && scan.stamp && *odometry.stamp >= *scan.stamp;
    });
    if (!between.empty()) last_odometry_ = between.back().stamp;
    if (own && scan.stamp) last_odometry_ = scan.stamp;
    scan.odometry.insert(scan.odometry.begin(), between.begin(), between.end());
    if (!note.empty()) scan.notes.push_back(std::move(note));
  };
  const auto add_line = [&](Words& words) {
    try {
      const auto odometry = parse_odometry(words);
      const auto last = between.empty() ? last_odometry_ : between.back().stamp;
      if (odometry && (!last || *odometry->stamp > *last)) between.push_back(*odometry);
    } catch (const ScanFileError& error) {
      // The scans are of use without it.
      if (!bad_odometry_) note = std::string("odometry is passed over: ") + error.what();
      bad_odometry_ = true;
    }
  };
  std::string_view line;
  while (lines.next(line)) {
    Words words(lines, line);
    std::string_view name;
    if (!words.next(name)) continue;
    words.begin(name);
    if (name == "FLASER") {
      scan.clear();
      if (std::string guess = parse_flaser(words, geometry_, scan); !guess.empty()) {
        scan.notes.push_back(std::move(guess));
      }
      add_odometry_between();
      return true;
    }
    if (name == "ODOM") add_line(words);
    if (name == "ROBOTLASER1" || name == "RAWLASER1") {
      scan.clear();
      parse_laser(words, name == "ROBOTLASER1", scan);
      add_odometry_between();
      return true;
    }
  }
  return false;
}

}  // namespace quoin::sensor_bridge
