// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/recordings/parameters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::sensor_bridge {

[[nodiscard]] inline const KindInfo& replay_kind() {
  static const KindInfo kind{.name = "replay",
                             .description = "scans, odometry or other messages of a recorded file",
                             .program = "quoin-replay",
                             .outputs = {{"scan", Rate::per_input, "messages"},
                                         {"odometry", Rate::own_rate, "odometry"},
                                         {"segments", Rate::own_rate, "messages"},
                                         {"lines", Rate::own_rate, "messages"},
                                         {"corners", Rate::own_rate, "messages"},
                                         {"circles", Rate::own_rate, "messages"},
                                         {"pose", Rate::own_rate, "messages"},
                                         {"line_map", Rate::own_rate, "messages"}},
                             .parameters = describe_parameters<ReplayParameters>()};
  return kind;
}

}  // namespace quoin::sensor_bridge
