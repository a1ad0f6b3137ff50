// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/parameters/parameter.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Slowest and fastest that an S1 turns [rev/min].
inline constexpr std::uint16_t slowest_motor = 480;
inline constexpr std::uint16_t fastest_motor = 900;

/// Settings of an emulated RPLIDAR. The defaults are a new S1 on a serial line.
struct EmulatorSettings {
  std::string model = "S1";  ///< A1, A2, A3, C1, S1, S2 or S3
  std::string firmware;      ///< such as 1.15; "" for that of the model
  /// A built-in world, or the path of a world file. The device stands at the world's first way
  /// point, its front along the heading there.
  std::string environment = "domestic_room";
  double speed = 0.0;  ///< [m/s] along the world's path, there and back

  std::string connection = "pty";  ///< where clients find the device: pty, tcp or udp
  /// A symbolic link to the pseudo-terminal, there while the device is plugged in; "" for none.
  std::string link;
  std::string address = "127.0.0.1";  ///< that TCP and UDP listen on
  std::int64_t port = 0;              ///< of TCP and UDP; 0 lets the kernel choose
  std::int64_t baud_rate = 0;         ///< [bit/s] of the serial line; 0 for that of the model

  double frequency = 10.0;      ///< [Hz] revolutions until the client sets others
  double spin_up_time = 1.0;    ///< [s] from rest to 10 Hz
  double reset_time = 2.0;      ///< [s] deaf after a reset and after being plugged in
  double range_min = 0.1;       ///< [m]
  double range_max = 40.0;      ///< [m]
  double range_stddev = 0.010;  ///< [m] noise of each range
  double clock_error = 0.0;     ///< relative error of the device's clock; positive is slow
  std::int64_t seed = 1;        ///< same seed, same noise
  std::string serial_number = "7E11EAF2C5E19BCFC2E19FF589C34509";  ///< 32 hexadecimal digits
  bool all_formats = false;  ///< offers scan modes for the formats that an S1 does not send, too
  std::string faults;        ///< misbehaviour to come, see parse_faults; "" for none

  static constexpr auto fields() {
    using P = EmulatorSettings;
    return std::tuple{
        field<P, std::string>(&P::model, "model", "A1, A2, A3, C1, S1, S2 or S3"),
        field<P, std::string>(&P::firmware, "firmware",
                              "such as 1.15; empty for a usual one of the model"),
        field<P, std::string>(&P::environment, "environment",
                              "name of a built-in world, or path of a world file (in a deployment: "
                              "relative to its file)"),
        field<P, double>(&P::speed, "speed", "m/s", 0.0, 100.0,
                         "speed along the world's path, there and back"),
        field<P, std::string>(&P::connection, "connection",
                              "where clients find the device: pty, tcp or udp"),
        field<P, std::string>(&P::link, "link", "symbolic link to the pseudo-terminal"),
        field<P, std::string>(&P::address, "address", "address that tcp and udp listen on"),
        field<P, std::int64_t>(&P::port, "port", "", 0.0, 65535.0,
                               "port of tcp and udp; 0 lets the kernel choose"),
        field<P, std::int64_t>(&P::baud_rate, "baud_rate", "", 0.0, 10e6,
                               "bits a second of the device's serial line; 0 for the model's"),
        field<P, double>(&P::frequency, "frequency", "Hz", 1.0, 20.0,
                         "revolutions a second until a client sets it, as far as the model can"),
        field<P, double>(&P::spin_up_time, "spin_up_time", "s", 0.0, 3600.0, "from rest to 10 Hz"),
        field<P, double>(&P::reset_time, "reset_time", "s", 0.0, 3600.0,
                         "deaf after a reset and after being plugged in"),
        field<P, double>(&P::range_min, "range_min", "m", 0.0, 1000.0,
                         "shortest range that is measured"),
        field<P, double>(&P::range_max, "range_max", "m", 0.01, 1000.0,
                         "longest range that is measured"),
        field<P, double>(&P::range_stddev, "range_stddev", "m", 0.0, 1.0, "noise of each range"),
        field<P, double>(&P::clock_error, "clock_error", "", -0.05, 0.05,
                         "relative error of the device's clock; positive is slow"),
        field<P, std::int64_t>(&P::seed, "seed", "", 0.0, 9007199254740992.0, "seed of the noise"),
        field<P, std::string>(&P::serial_number, "serial_number", "32 hexadecimal digits"),
        field<P, bool>(&P::all_formats, "all_formats",
                       "scan modes for the formats that an S1 does not send, too"),
        field<P, std::string>(&P::faults, "faults",
                              "misbehaviour to come, such as 'unplug@20s+5s'; "
                              "quoin-rplidar-emulator --help lists the kinds")};
  }
};

}  // namespace quoin::sensor_bridge::rplidar
