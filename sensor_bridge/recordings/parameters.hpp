// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/parameters/parameter.hpp"
#include "core/sensor/sensor_fields.hpp"

namespace quoin::sensor_bridge {

/// How a scan file is written.
enum class ScanFormat {
  automatic,   ///< by the file's first bytes and its name
  carmen,      ///< text log with FLASER, ROBOTLASER1 or RAWLASER1 lines, plain or compressed
  csv,         ///< a table, a line per ray
  json,        ///< an object of scans with raw odometry by their stamps
  triples,     ///< JSON lists of [quality, angle, distance] as Python drivers give them
  breezyslam,  ///< a line of numbers per scan, with what the wheels count
  messages,    ///< MCAP, ROS 1 bag or ROS 2 bag
};

/// When a recorded scan says that it was acquired.
enum class ReplayStamps {
  publication,  ///< now, as if it had been: ages downstream make sense
  recorded,     ///< as the recording has it: what comes of it does not depend on `speed`
};

}  // namespace quoin::sensor_bridge

namespace quoin {

template <>
struct EnumNames<sensor_bridge::ScanFormat> {
  static constexpr std::array<std::pair<sensor_bridge::ScanFormat, std::string_view>, 7> names{
      {{sensor_bridge::ScanFormat::automatic, "automatic"},
       {sensor_bridge::ScanFormat::carmen, "carmen"},
       {sensor_bridge::ScanFormat::csv, "csv"},
       {sensor_bridge::ScanFormat::json, "json"},
       {sensor_bridge::ScanFormat::triples, "triples"},
       {sensor_bridge::ScanFormat::breezyslam, "breezyslam"},
       {sensor_bridge::ScanFormat::messages, "messages"}}};
};

template <>
struct EnumNames<sensor_bridge::ReplayStamps> {
  static constexpr std::array<std::pair<sensor_bridge::ReplayStamps, std::string_view>, 2> names{
      {{sensor_bridge::ReplayStamps::publication, "publication"},
       {sensor_bridge::ReplayStamps::recorded, "recorded"}}};
};

}  // namespace quoin

namespace quoin::sensor_bridge {

/// Parameters of the publisher of recorded scans. Limits default to the SICK
/// LMS that most CARMEN logs were taken with: 180 degrees, readings of 80 m and more mean "no
/// return".
struct ReplayParameters : SensorDeclaration {
  static constexpr double usual_range_max = 80.0;  ///< [m] left so, a limit in the file is used

  std::string path;
  std::string messages = "scan";
  ScanFormat format = ScanFormat::automatic;
  double speed = 1.0;  ///< factor
  bool paused = false;
  bool loop = false;
  std::int64_t scans = 0;  ///< 0: all
  double rate_hz = 10.0;   ///< [Hz]
  ReplayStamps stamps = ReplayStamps::publication;
  bool odometry = false;
  double start = 0.0;  ///< [s]
  std::string topic;
  std::string columns;
  double field_of_view = 0.0;  ///< [rad] 0: 180 deg, unless the file says
  double start_angle = 0.0;    ///< [rad]
  double angle_step = 0.0;     ///< [rad]
  bool clockwise = false;
  bool inverted = false;
  double angle_offset = 0.0;    ///< [rad]
  double leave_out_from = 0.0;  ///< [rad]
  double leave_out_to = 0.0;    ///< [rad]
  double range_min = 0.0;       ///< [m]
  double range_max = usual_range_max;
  std::string frame = "laser";
  std::string base_frame = "base_link";
  std::string odometry_frame = "odom";

  /// Whether the noise of the sensor is given, or left as it is by default.
  [[nodiscard]] bool declares_sensor() const {
    const SensorDeclaration usual;
    return range_stddev != usual.range_stddev || bearing_stddev != usual.bearing_stddev ||
           range_bias_stddev != usual.range_bias_stddev ||
           range_stddev_per_metre != usual.range_stddev_per_metre ||
           flatness_stddev != usual.flatness_stddev || noise != usual.noise;
  }

  static constexpr auto fields() {
    using P = ReplayParameters;
    const std::tuple own{
        required_field(
            &P::path, "path",
            "recording (CARMEN, CSV, JSON, .dat, MCAP, ROS 1 and ROS 2 bags), or folder whose scan "
            "files are read in the order of their names (relative to the deployment file)"),
        field(&P::messages, "messages",
              "types to publish, with commas: scan, or of a recording of ours segments, lines, "
              "corners, circles, pose, line_map, to test what follows; odometry has a parameter of "
              "its own"),
        field(&P::format, "format", "how the files are written"),
        field(&P::speed, "speed", "", 0.0, 1000.0,
              "factor on the recorded speed; 0 is as fast as the readers accept"),
        field(&P::paused, "paused", "wait with the first scan for quoin playback"),
        field(&P::loop, "loop", "start again after the last scan"),
        field(&P::scans, "scans", "", 0.0, 9007199254740992.0,
              "scans, or other messages, to publish before ending; 0 is all"),
        field(&P::rate_hz, "rate_hz", "Hz", 0.1, 1000.0,
              "scans a second where the file holds no usable time stamps"),
        field(&P::stamps, "stamps",
              "publication: scans are stamped as they are published; recorded: as the file has it, "
              "which mapping at another speed needs"),
        field(&P::odometry, "odometry",
              "publish the odometry of the recording, too; many logs hold poses that a mapper has "
              "corrected under that name"),
        field(&P::start, "start", "s", 0.0, 1e9, "leave out what comes before, by the stamps"),
        field(
            &P::topic, "topic",
            "of an MCAP file or bag, with commas where several are published; empty: the only one "
            "of its type"),
        field(&P::columns, "columns",
              "names of the columns of CSV files, such as quality;angle_deg;distance_mm; empty: as "
              "the file says, or by guess"),
        field(&P::field_of_view, "field_of_view", "rad", 0.0, 6.2832,
              "swept angle of FLASER lines and JSON scans, from the first to the last ray, centred "
              "on the x axis; 0 is 180 deg"),
        field(&P::start_angle, "start_angle", "rad", -6.2832, 6.2832,
              "direction of the first ray, with angle_step"),
        field(&P::angle_step, "angle_step", "rad", -3.1416, 3.1416,
              "from ray to ray, negative clockwise: takes the place of all bearings of the file; 0 "
              "is as the file has them"),
        field(&P::clockwise, "clockwise", "bearings of the file count clockwise"),
        field(&P::inverted, "inverted", "the sensor hangs upside down"),
        field(&P::angle_offset, "angle_offset", "rad", -6.2832, 6.2832,
              "added to all bearings, after the above"),
        field(&P::leave_out_from, "leave_out_from", "rad", -6.2832, 6.2832,
              "rays from here counter-clockwise"),
        field(&P::leave_out_to, "leave_out_to", "rad", -6.2832, 6.2832,
              "to here are invalid, such as those on the robot itself; the same: none"),
        field(&P::range_min, "range_min", "m", 0.0, 1000.0, "shorter ranges are too close"),
        field(&P::range_max, "range_max", "m", 0.01, 10000.0,
              "this and longer is no return; 80 m: or what the file says"),
        field(&P::frame, "frame", "frame of the sensor (REP-105); left so, that of the file"),
        field(&P::base_frame, "base_frame", "frame of the robot, whose odometry it is"),
        field(&P::odometry_frame, "odometry_frame", "frame in which odometry is given")};
    return std::tuple_cat(own, sensor_fields<P>());
  }
};

}  // namespace quoin::sensor_bridge
