// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/driver/driver_settings.hpp"
#include "sensor_bridge/rplidar/driver/interruption.hpp"
#include "sensor_bridge/rplidar/driver/stop_motor.hpp"
#include "sensor_bridge/rplidar/protocol/device_info.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Opens the way to the device, for serial ports at this baud rate. Throws TransportError.
using Opener = std::function<std::unique_ptr<Transport>(unsigned baud_rate)>;

[[nodiscard]] Opener opener_of(const DriverSettings& settings);

/// A device that has been identified and is idle; its motor is stopped at the end.
struct Connection {
  MotorGuard guard;
  unsigned baud_rate = 0;  ///< of a serial port
  DeviceInfo info;
  bool was_sending = false;  ///< it was measuring when it was found
};

/// What to try at this endpoint, the likeliest first: `first` if it is not 0, then the usual ones.
[[nodiscard]] std::vector<unsigned> baud_rates_for(const Endpoint& endpoint, unsigned first);

/// Tries the baud rates until a device answers. Throws DeviceError that reports the most that was
/// learned, TransportError, or Stopped.
[[nodiscard]] Connection find_device(const Opener& open, const std::string& name,
                                     std::span<const unsigned> baud_rates,
                                     const Interruption& interruption, const TimeOuts& time_outs);

}  // namespace quoin::sensor_bridge::rplidar
