// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::sensor_bridge::rplidar {

[[nodiscard]] inline const KindInfo& rplidar_emulator_kind() {
  static const KindInfo kind{
      .name = "rplidar_emulator",
      .description =
          "an RPLIDAR without hardware, for a service of kind rplidar or any other client",
      .program = "quoin-rplidar-emulator-service",
      .exclusive = true,
      .device = "link",
      .parameters = describe_parameters<EmulatorSettings>()};
  return kind;
}

}  // namespace quoin::sensor_bridge::rplidar
