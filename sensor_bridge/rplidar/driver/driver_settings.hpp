// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "sensor_bridge/transport/endpoint.hpp"

namespace quoin::sensor_bridge::rplidar {

/// How long to wait for what. The values suit a real device; tests use shorter ones.
struct TimeOuts {
  using Time = std::chrono::milliseconds;

  Time connection{1000};       ///< of TCP
  Time probing{500};           ///< for the first answer at a baud rate; asked twice
  Time answer{1000};           ///< to a request, or to one that hands bytes over
  Time quiet{50};              ///< without a byte: the device has stopped sending
  Time draining{300};          ///< for it to become quiet
  Time reset{2000};            ///< from a reset until an S1 takes requests again
  Time spin_up{8000};          ///< from the start of a scan to its first measurements
  Time silence{1000};          ///< between measurements
  Time window{1000};           ///< in which damaged frames are counted
  Time revolution{3000};       ///< between complete revolutions
  Time stable{5000};           ///< of measurements, after which earlier failures are forgotten
  Time between_resets{60000};  ///< once a few of them in a row were of no help
  Time shortest_pause{50};     ///< between attempts to connect; doubles each time
  Time longest_pause{500};
  Time busy_pause{2000};  ///< where another program uses the port, whose name is costly to find
};

struct DriverSettings {
  Endpoint endpoint;
  unsigned baud_rate = 0;       ///< of a serial port; 0 finds it
  std::string scan_mode;        ///< name; empty for the one that the device calls typical
  double scan_frequency = 0.0;  ///< [Hz] revolutions per second; 0 for the device's own
  /// Time without anybody who wants the revolutions after which the motor is stopped; 0: never.
  TimeOuts::Time idle_stop{0};
  TimeOuts time_outs;
};

}  // namespace quoin::sensor_bridge::rplidar
