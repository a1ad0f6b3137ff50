// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "sensor_bridge/rplidar/driver/connection.hpp"
#include "sensor_bridge/rplidar/driver/device_facts.hpp"
#include "sensor_bridge/rplidar/driver/diagnosis.hpp"

namespace quoin::sensor_bridge::rplidar {

struct ProbeReport {
  Diagnosis diagnosis;
  std::optional<DeviceFacts> facts;  ///< when a device has identified itself
  bool was_sending = false;          ///< it was found in the middle of a scan
};

/// Identifies the device at the endpoint, at whatever baud rate, without a measurement. The device
/// is idle afterwards, also one that was found scanning. Throws nothing but Stopped.
[[nodiscard]] ProbeReport probe(const DriverSettings& settings, const Interruption& interruption,
                                Opener open = {});

}  // namespace quoin::sensor_bridge::rplidar
