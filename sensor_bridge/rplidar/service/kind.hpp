// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/rplidar/service/parameters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::sensor_bridge::rplidar {

[[nodiscard]] inline const KindInfo& rplidar_kind() {
  static const KindInfo kind{.name = "rplidar",
                             .description = "scans of an RPLIDAR on a serial port, TCP or UDP",
                             .program = "quoin-rplidar",
                             .outputs = {{"scan"}},
                             .device = "serial_port",
                             .parameters = describe_parameters<RplidarParameters>()};
  return kind;
}

}  // namespace quoin::sensor_bridge::rplidar
