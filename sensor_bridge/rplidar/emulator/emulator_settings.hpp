// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace quoin::sensor_bridge::rplidar {

/// What an emulated RPLIDAR S1 can be told. The defaults are a new S1 on a serial line.
struct EmulatorSettings {
  /// A built-in world, or the path of a world file. The device stands at the world's first way
  /// point, its front along the heading there.
  std::string environment = "domestic_room";
  double speed = 0.0;  ///< [m/s] along the world's path, there and back

  std::string connection = "pty";  ///< where clients find the device: pty, tcp or udp
  /// A symbolic link to the pseudo-terminal, there while the device is plugged in; "" for none.
  std::string link;
  std::string address = "127.0.0.1";  ///< that TCP and UDP listen on
  std::int64_t port = 0;              ///< of TCP and UDP; 0 lets the kernel choose
  std::int64_t baud_rate = 256000;    ///< [bit/s] of the device's serial line

  double frequency = 10.0;      ///< [Hz] revolutions until the client sets others; 8 to 15
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
};

}  // namespace quoin::sensor_bridge::rplidar
