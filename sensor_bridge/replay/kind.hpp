// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/recordings/parameters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::sensor_bridge {

[[nodiscard]] inline const KindInfo& replay_kind() {
  static const KindInfo kind{.name = "replay",
                             .description = "scans, and odometry if asked to, of a recorded file",
                             .program = "quoin-replay",
                             .outputs = {{"scan"}, {"odometry", Rate::own_rate, "odometry"}},
                             .parameters = describe_parameters<ReplayParameters>()};
  return kind;
}

}  // namespace quoin::sensor_bridge
