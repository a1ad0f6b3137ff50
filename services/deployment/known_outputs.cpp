// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/known_outputs.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace quoin {

namespace {

KindInfo kind_of(const char* name, std::vector<OutputPort> outputs,
                 std::vector<ParameterInfo> parameters = {}) {
  KindInfo kind;
  kind.name = name;
  kind.outputs = std::move(outputs);
  kind.parameters = std::move(parameters);
  return kind;
}

ParameterInfo parameter_of(const char* name, ParameterType type, const char* default_value) {
  ParameterInfo parameter;
  parameter.name = name;
  parameter.type = type;
  parameter.default_value = default_value;
  return parameter;
}

ParameterInfo switch_of(const char* name) {
  return parameter_of(name, ParameterType::boolean, "false");
}

}  // namespace

const KindInfo* known_outputs(std::string_view kind) {
  using enum Rate;
  static const std::vector<KindInfo> table{
      kind_of("simulated",
              {{"scan"}, {"odometry", own_rate, "odometry"}, {"pose", own_rate, "truth"}},
              {switch_of("odometry"), switch_of("truth")}),
      kind_of("replay",
              {{"scan", per_input, "messages"},
               {"odometry", own_rate, "odometry"},
               {"segments", own_rate, "messages"},
               {"lines", own_rate, "messages"},
               {"corners", own_rate, "messages"},
               {"circles", own_rate, "messages"},
               {"pose", own_rate, "messages"},
               {"line_map", own_rate, "messages"}},
              {parameter_of("messages", ParameterType::text, "scan"), switch_of("odometry")}),
      kind_of("rplidar", {{"scan"}}),
      kind_of("rplidar_emulator", {}),
      kind_of("ros2_scan", {{"scan"}}),
      kind_of("ros2_odometry", {{"odometry", own_rate}}),
      kind_of("deskewing", {{"scan"}}),
      kind_of("segmentation", {{"segments"}}),
      kind_of("line_fitting", {{"lines"}}),
      kind_of("corner_estimation", {{"corners"}}),
      kind_of("circle_fitting", {{"circles"}}),
      kind_of("mapping", {{"pose"}, {"line_map", own_rate}}),
      kind_of("localization", {{"pose"}, {"line_map", own_rate}}),
      kind_of("viewer", {}),
      kind_of("recorder", {}),
      kind_of("ros2_output", {})};
  const auto found = std::ranges::find(table, kind, &KindInfo::name);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace quoin
