// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/methods/parameter.hpp"
#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"

namespace quoin::sensor_bridge::rplidar {

/// The emulator's settings as parameters of a service.
struct EmulatorParameters : EmulatorSettings {
  static constexpr auto fields() {
    using P = EmulatorParameters;
    return std::tuple{
        field<P, std::string>(
            &P::environment, "environment",
            "name of a built-in world, or path of a world file (relative to the deployment file)"),
        field<P, double>(&P::speed, "speed", "m/s", 0.0, 100.0,
                         "speed along the world's path, there and back"),
        field<P, std::string>(&P::connection, "connection",
                              "where clients find the device: pty, tcp or udp"),
        field<P, std::string>(&P::link, "link", "symbolic link to the pseudo-terminal"),
        field<P, std::string>(&P::address, "address", "address that tcp and udp listen on"),
        field<P, std::int64_t>(&P::port, "port", "", 0.0, 65535.0,
                               "port of tcp and udp; 0 lets the kernel choose"),
        field<P, std::int64_t>(&P::baud_rate, "baud_rate", "", 1.0, 4000000.0,
                               "bits a second of the device's serial line"),
        field<P, double>(&P::frequency, "frequency", "Hz", 8.0, 15.0,
                         "revolutions a second until a client sets it"),
        field<P, double>(&P::spin_up_time, "spin_up_time", "s", 0.0, 3600.0, "from rest to 10 Hz"),
        field<P, double>(&P::reset_time, "reset_time", "s", 0.0, 3600.0,
                         "deaf after a reset and after being plugged in"),
        field<P, double>(&P::range_min, "range_min", "m", 0.0, 1000.0,
                         "shortest range that is measured"),
        field<P, double>(&P::range_max, "range_max", "m", 0.01, 1000.0,
                         "longest range that is measured"),
        field<P, double>(&P::range_stddev, "range_stddev", "m", 0.0, 1.0, "noise of each range"),
        field<P, double>(&P::clock_error, "clock_error", "", -0.01, 0.01,
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
