// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "services/deployment/known_outputs.hpp"
#include "services/ros2_output/parameters.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& ros2_output_kind() {
  static const KindInfo kind{
      .name = "ros2_output",
      .description =
          "publishes what services give as messages of ROS 2: scans, markers, poses, "
          "transforms, maps, diagnostics",
      .program = "quoin-ros2-output",
      .observer = true,
      .known_outputs = known_outputs,
      .parameters = describe_parameters<Ros2OutputParameters>()};
  return kind;
}

}  // namespace quoin
