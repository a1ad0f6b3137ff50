// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/driver_listener.hpp"

namespace quoin::sensor_bridge::rplidar {

std::string_view name_of(DriverState state) {
  switch (state) {
    case DriverState::connecting:
      return "connecting";
    case DriverState::starting:
      return "starting";
    case DriverState::measuring:
      return "measuring";
    case DriverState::standby:
      return "standby";
    case DriverState::recovering:
      return "recovering";
    case DriverState::waiting:
      return "waiting";
    case DriverState::stopped:
      break;
  }
  return "stopped";
}

}  // namespace quoin::sensor_bridge::rplidar
