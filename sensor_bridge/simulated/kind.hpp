// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/simulated/parameters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::sensor_bridge {

[[nodiscard]] inline const KindInfo& simulated_kind() {
  static const KindInfo kind{
      .name = "simulated",
      .description =
          "scans of a simulated sensor in a world, built in or of a file; odometry of "
          "its robot and the true pose if asked to",
      .program = "quoin-simulated",
      .outputs = {{"scan"},
                  {"odometry", Rate::own_rate, "odometry"},
                  {"pose", Rate::own_rate, "truth"}},
      .parameters = describe_parameters<SimulatedParameters>()};
  return kind;
}

}  // namespace quoin::sensor_bridge
