// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <idl/Scan.h>
#include <string>
#include <string_view>

#include "services/ros2/messages.hpp"

namespace quoin::ros2 {

/// Which ray of a LaserScan was measured at its stamp. The message definition says the first.
enum class StampedRay { first, last };

/// What is wrong with a LaserScan, or with it after the one before.
enum class ScanFault {
  // It cannot be used.
  too_many_rays,
  no_angle_min,
  no_increment,
  other_frame,
  // It is used all the same.
  no_rays,
  increment_from_angle_max,
  increment_against_angle_max,
  angle_max_elsewhere,
  ray_count_changed,
  intensities_of_other_length,
  no_range_limits,
  no_time_increment,
  stamp_zero,
  stamp_of_another_clock,
  stamp_not_later,
  no_frame,
  frame_changed,
};
inline constexpr std::size_t scan_fault_count = 17;

/// What it is and what is done about it, such as "angle_increment is 0 or no number: left out".
[[nodiscard]] std::string_view text_of(ScanFault fault);
/// Whether the scan is left out.
[[nodiscard]] constexpr bool fatal(ScanFault fault) { return fault <= ScanFault::other_frame; }

struct ScanImportOptions {
  StampedRay stamped = StampedRay::first;
  /// Scans of other frames are left out; "" takes the frames as they come.
  std::string frame = {};
  double range_min = 0.0;    ///< [m] shorter ranges are too close, whatever the topic says
  double range_max = 1.0e4;  ///< [m] longer ones are no return
};

/// Turns sensor_msgs/LaserScan into scans, and counts what is wrong with them.
class ScanImport {
 public:
  /// Rays of a scan; more are no scan of a 2D LiDAR.
  static constexpr std::size_t most_rays = 100'000;

  explicit ScanImport(ScanImportOptions options) : options_(std::move(options)) {}

  /// Fills in frame, stamp, limits and rays of `out`, whose memory is reused; bearings are
  /// angle_min + i angle_increment, as other programs of ROS 2 read them, clockwise or
  /// counter-clockwise. Ranges are made what REP-117 says: +inf beyond the limit, -inf before it,
  /// NaN for 0 and what is no range. `received` [ns since the Unix epoch] is when it came. False
  /// when it cannot be used.
  [[nodiscard]] bool convert(const LaserScan& in, std::int64_t received, msg::Scan& out);

  struct Tally {
    std::uint64_t count = 0;
    std::uint64_t last = 0;  ///< number of the last scan that had it, from 0
  };
  [[nodiscard]] const Tally& tally(ScanFault fault) const {
    return tallies_[static_cast<std::size_t>(fault)];
  }
  /// Scans that came.
  [[nodiscard]] std::uint64_t taken() const { return taken_; }
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }
  /// Faults that were found, all together; grows when another one is found.
  [[nodiscard]] std::uint64_t faults() const { return faults_; }

 private:
  bool note(ScanFault fault);
  [[nodiscard]] double increment_of(const LaserScan& in);
  void set_times(const LaserScan& in, std::int64_t received, msg::Scan& out);
  void set_ranges(const LaserScan& in, msg::Scan& out);

  const ScanImportOptions options_;
  std::array<Tally, scan_fault_count> tallies_{};
  std::uint64_t taken_ = 0;
  std::uint64_t left_out_ = 0;
  std::uint64_t faults_ = 0;
  // Of the scan before.
  std::size_t rays_ = 0;
  std::int64_t stamp_ = 0;
  std::string frame_;
};

}  // namespace quoin::ros2
