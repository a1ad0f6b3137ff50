// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/parameters/parameter.hpp"
#include "core/sensor/sensor_fields.hpp"
#include "sensor_bridge/mounting.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Parameters of the RPLIDAR bridge; names as in the vendor's ROS driver where it has them.
struct RplidarParameters : SensorDeclaration, Mounting {
  std::string serial_port = "auto";
  std::int64_t serial_baudrate = 0;  ///< [bit/s]; 0 finds it
  std::string scan_mode;             ///< empty for the one that the device calls typical
  double scan_frequency = 0.0;       ///< [Hz] 0 for the device's own
  double idle_stop = 0.0;            ///< [s] 0: never
  double answer_timeout = 1.0;       ///< [s]
  double spin_up_timeout = 8.0;      ///< [s]
  std::int64_t bins = 0;             ///< 0: true bearings
  double range_min = 0.1;            ///< [m]
  double range_max = 0.0;            ///< [m] 0 for what the device says of the scan mode
  std::string frame = "laser";

  static constexpr auto fields() {
    using P = RplidarParameters;
    const std::tuple own{
        field(&P::serial_port, "serial_port",
              "serial device (./ is relative to the deployment file), tcp://host[:20108] or "
              "udp://host[:8089]; auto takes the only USB serial adapter of the usual type"),
        field(&P::serial_baudrate, "serial_baudrate", "", 0.0, 4000000.0,
              "bits a second of a serial port, 256000 for an S1; 0 tries the usual ones"),
        field(&P::scan_mode, "scan_mode",
              "name of a scan mode, such as DenseBoost; empty for the one that the device calls "
              "typical"),
        field(&P::scan_frequency, "scan_frequency", "Hz", 0.0, 30.0,
              "revolutions a second; 0 for the device's own choice"),
        field(&P::idle_stop, "idle_stop", "s", 0.0, 86400.0,
              "time without a reader of the scans after which the motor is stopped, until there is "
              "one; 0 never stops it"),
        field(&P::answer_timeout, "answer_timeout", "s", 0.05, 30.0,
              "longest wait for an answer of the device"),
        field(&P::spin_up_timeout, "spin_up_timeout", "s", 0.5, 120.0,
              "longest wait for the first measurements of a scan"),
        field(&P::bins, "bins", "", 0.0, 32768.0,
              "resample to so many equally spaced bearings; 0 keeps the measured ones"),
        field(&P::range_min, "range_min", "m", 0.0, 1000.0, "shortest range that is measured"),
        field(&P::range_max, "range_max", "m", 0.0, 1000.0,
              "longest range that is measured; 0 for what the device says"),
        field(&P::frame, "frame_id", "frame of the sensor (REP-105)")};
    return std::tuple_cat(own, mounting_fields<P>(), sensor_fields<P>());
  }
};

}  // namespace quoin::sensor_bridge::rplidar
