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
  automatic,   ///< by the file's name: .csv, .log (carmen), .json, .dat (breezyslam), each also .gz
  carmen,      ///< text log with FLASER lines, plain or compressed
  csv,         ///< one revolution, a line "bearing,range" per ray
  json,        ///< an object of scans with raw odometry by their stamps
  breezyslam,  ///< a line of numbers per scan, with what the wheels count
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
  static constexpr std::array<std::pair<sensor_bridge::ScanFormat, std::string_view>, 5> names{
      {{sensor_bridge::ScanFormat::automatic, "automatic"},
       {sensor_bridge::ScanFormat::carmen, "carmen"},
       {sensor_bridge::ScanFormat::csv, "csv"},
       {sensor_bridge::ScanFormat::json, "json"},
       {sensor_bridge::ScanFormat::breezyslam, "breezyslam"}}};
};

template <>
struct EnumNames<sensor_bridge::ReplayStamps> {
  static constexpr std::array<std::pair<sensor_bridge::ReplayStamps, std::string_view>, 2> names{
      {{sensor_bridge::ReplayStamps::publication, "publication"},
       {sensor_bridge::ReplayStamps::recorded, "recorded"}}};
};

}  // namespace quoin

namespace quoin::sensor_bridge {

/// Parameters of the publisher of recorded scans. Limits and field of view default to the SICK
/// LMS that most CARMEN logs were taken with: 180 degrees, readings of 80 m and more mean "no
/// return".
struct ReplayParameters : SensorDeclaration {
  std::string path;
  ScanFormat format = ScanFormat::automatic;
  double speed = 1.0;  ///< factor
  bool loop = false;
  std::int64_t scans = 0;  ///< 0: all
  double rate_hz = 10.0;   ///< [Hz]
  ReplayStamps stamps = ReplayStamps::publication;
  bool odometry = false;
  double field_of_view = 3.141592653589793;  ///< [rad]
  double range_min = 0.0;                    ///< [m]
  double range_max = 80.0;                   ///< [m]
  std::string frame = "laser";
  std::string base_frame = "base_link";
  std::string odometry_frame = "odom";

  static constexpr auto fields() {
    using P = ReplayParameters;
    const std::tuple own{
        required_field(
            &P::path, "path",
            "scan file, or folder whose .csv, .log and .dat files are read in the order of "
            "their names (relative to the deployment file)"),
        field(&P::format, "format", "how the files are written"),
        field(&P::speed, "speed", "", 0.0, 1000.0,
              "factor on the recorded speed; 0 is as fast as the readers accept"),
        field(&P::loop, "loop", "start again after the last scan"),
        field(&P::scans, "scans", "", 0.0, 9007199254740992.0,
              "scans to publish before ending; 0 is all"),
        field(&P::rate_hz, "rate_hz", "Hz", 0.1, 1000.0,
              "scans a second where the file holds no usable time stamps"),
        field(&P::stamps, "stamps",
              "publication: scans are stamped as they are published; recorded: as the file has it, "
              "which mapping at another speed needs"),
        field(&P::odometry, "odometry",
              "publish the odometry of the recording, too; many logs hold poses that a mapper has "
              "corrected under that name"),
        field(&P::field_of_view, "field_of_view", "rad", 0.001, 6.2832,
              "swept angle of CARMEN and JSON scans, centred on the x axis"),
        field(&P::range_min, "range_min", "m", 0.0, 1000.0, "shorter ranges are too close"),
        field(&P::range_max, "range_max", "m", 0.01, 10000.0, "this and longer is no return"),
        field(&P::frame, "frame", "frame of the sensor (REP-105)"),
        field(&P::base_frame, "base_frame", "frame of the robot, whose odometry it is"),
        field(&P::odometry_frame, "odometry_frame", "frame in which odometry is given")};
    return std::tuple_cat(own, sensor_fields<P>());
  }
};

}  // namespace quoin::sensor_bridge
