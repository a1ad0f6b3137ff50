// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/laser_scan_message.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>

#include "sensor_bridge/recordings/ros1_cursor.hpp"
#include "services/topics/cdr_cursor.hpp"

namespace quoin::sensor_bridge {

namespace {

using topics::CdrCursor;

class CdrFloats : public CdrCursor {
 public:
  using CdrCursor::CdrCursor;
  void floats(std::size_t count, std::vector<float>& out) {
    // Before anything is reserved: the length may be anything.
    require(std::uint64_t{count} * sizeof(float));
    block_.clear();
    append_block<float>(count, block_);
    out.resize(count);
    if (count > 0) std::memcpy(out.data(), block_.data(), block_.size());
  }

 private:
  std::string block_;
};

template <class Cursor>
void read_floats(Cursor& cursor, std::vector<float>& out) {
  const std::size_t count = cursor.sequence_length(0);
  if (count > RecordedScan::max_points) {
    throw std::runtime_error(std::to_string(count) + " rays, more than any sensor has");
  }
  cursor.floats(count, out);
}

void set_stamp(std::int64_t stamp, RecordedScan& scan) {
  scan.epoch_stamp = stamp;
  scan.stamp = static_cast<double>(stamp) * 1e-9;
}

/// sensor_msgs/LaserScan.
template <class Cursor>
void read_laser_scan(Cursor& cursor, bool numbered, RecordedScan& scan) {
  const RosHeader header = read_ros_header(cursor, numbered);
  set_stamp(header.stamp, scan);
  scan.frame = header.frame;
  const auto first = cursor.template primitive<float>();
  (void)cursor.template primitive<float>();  // the last bearing: by the step and the count
  const auto step = cursor.template primitive<float>();
  const auto time_step = cursor.template primitive<float>();
  (void)cursor.template primitive<float>();  // time between scans
  scan.range_min = cursor.template primitive<float>();
  scan.range_max = cursor.template primitive<float>();
  if (!std::isfinite(first) || !std::isfinite(step)) {
    throw std::runtime_error("its bearings are not numbers");
  }
  read_floats(cursor, scan.ranges);
  read_floats(cursor, scan.qualities);
  cursor.finish();
  if (scan.qualities.size() != scan.ranges.size()) scan.qualities.clear();
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    scan.bearings.push_back(
        static_cast<float>(static_cast<double>(first) + static_cast<double>(i) * step));
    if (time_step > 0.0F && time_step < 1.0F) {
      scan.time_offsets.push_back(static_cast<float>(i) * time_step);
    }
  }
}

/// quoin::msg::Scan (idl/Scan.idl).
void read_quoin_scan(CdrFloats& cursor, RecordedScan& scan) {
  for (std::size_t i = cursor.sequence_length(0); i > 0; --i) {  // origins
    (void)cursor.string(0);
    (void)cursor.primitive<std::uint64_t>();
    (void)cursor.primitive<std::uint64_t>();
    (void)cursor.primitive<std::uint32_t>();
    (void)cursor.primitive<std::uint32_t>();
  }
  set_stamp(cursor.primitive<std::int64_t>(), scan);
  scan.frame = cursor.string(0);
  for (std::size_t i = cursor.sequence_length(0); i > 0; --i) {  // trace
    for (int text = 0; text < 3; ++text) (void)cursor.string(0);
    for (int time = 0; time < 4; ++time) (void)cursor.primitive<std::uint64_t>();
  }
  SensorModel sensor;
  sensor.range_stddev = cursor.primitive<double>();
  sensor.bearing_stddev = cursor.primitive<double>();
  sensor.range_bias_stddev = cursor.primitive<double>();
  sensor.range_stddev_per_metre = cursor.primitive<double>();
  sensor.flatness_stddev = cursor.primitive<double>();
  scan.sensor_estimated = cursor.boolean();
  scan.sensor = sensor;
  scan.range_min = cursor.primitive<float>();
  scan.range_max = cursor.primitive<float>();
  scan.duration = cursor.primitive<float>();
  read_floats(cursor, scan.bearings);
  read_floats(cursor, scan.ranges);
  read_floats(cursor, scan.qualities);
  read_floats(cursor, scan.time_offsets);
  cursor.finish();
  if (scan.bearings.size() != scan.ranges.size()) {
    throw std::runtime_error(std::to_string(scan.bearings.size()) + " bearings and " +
                             std::to_string(scan.ranges.size()) + " ranges");
  }
}

}  // namespace

std::optional<ScanMessage> scan_message(std::string_view type, std::string_view encoding) {
  constexpr std::array names{"sensor_msgs/LaserScan", "sensor_msgs/msg/LaserScan",
                             "sensor_msgs::msg::LaserScan", "sensor_msgs::msg::dds_::LaserScan_"};
  for (const std::string_view name : names) {
    if (type != name) continue;
    if (encoding == "ros1") return ScanMessage::ros1_laser_scan;
    if (encoding == "cdr") return ScanMessage::ros2_laser_scan;
  }
  if (type == "quoin::msg::Scan" && encoding == "cdr") return ScanMessage::quoin_scan;
  return std::nullopt;
}

std::string read_scan_message(ScanMessage kind, std::string_view bytes, RecordedScan& scan) {
  scan.clear();
  try {
    if (kind == ScanMessage::ros1_laser_scan) {
      Ros1Cursor cursor(bytes);
      read_laser_scan(cursor, true, scan);
      return "";
    }
    CdrFloats cursor(kind == ScanMessage::quoin_scan ? "Scan" : "LaserScan",
                     std::as_bytes(std::span(bytes.data(), bytes.size())));
    if (kind == ScanMessage::quoin_scan) {
      read_quoin_scan(cursor, scan);
    } else {
      read_laser_scan(cursor, false, scan);
    }
    return "";
  } catch (const std::exception& error) {
    scan.clear();
    return std::string("a scan that cannot be read: ") + error.what();
  }
}

}  // namespace quoin::sensor_bridge
