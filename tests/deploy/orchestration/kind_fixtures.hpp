// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

// Kinds with several ports, made for the tests. Their program is the test program, which exists.

inline const KindInfo lidar{.name = "lidar",
                            .description = "",
                            .program = "launch_test",
                            .outputs = {{"scan"}, {"segments", Rate::own_rate}}};
inline const KindInfo fitter{.name = "fitter",
                             .description = "",
                             .program = "launch_test",
                             .inputs = {{"scan", "scan"}},
                             .outputs = {{"lines"}}};
inline const KindInfo device{
    .name = "device", .description = "", .program = "launch_test", .exclusive = true};
inline const KindInfo tape{
    .name = "tape", .description = "", .program = "launch_test", .observer = true};
inline const KindInfo missing{
    .name = "missing", .description = "", .program = "no-such-program", .outputs = {{"scan"}}};
/// Its methods keep what they know: two of them in one form.
inline const KindInfo mapper{
    .name = "mapper",
    .description = "",
    .program = "launch_test",
    .inputs = {{"lines", "lines"}, {"odometry", "segments", Join::by_time}},
    .outputs = {{"corners"}},
    .methods = {{.name = "plain", .description = "", .source = "", .choose = "", .parameters = {}},
                {.name = "lines",
                 .description = "",
                 .source = "",
                 .choose = "",
                 .parameters = {},
                 .state = "line_map/1"},
                {.name = "fast_lines",
                 .description = "",
                 .source = "",
                 .choose = "",
                 .parameters = {},
                 .state = "line_map/1"},
                {.name = "grid",
                 .description = "",
                 .source = "",
                 .choose = "",
                 .parameters = {},
                 .state = "grid/1"}}};

[[nodiscard]] inline ServiceConfig service(
    const std::string& name, const KindInfo& kind,
    std::vector<std::pair<std::string, std::string>> inputs = {}, const std::string& method = "") {
  ServiceConfig config;
  config.name = name;
  config.kind = kind.name;
  config.info = &kind;
  config.method = method;
  for (auto& [port, writer] : inputs) config.inputs.push_back({port, writer, {}});
  for (const OutputPort& port : kind.outputs) {
    config.outputs.push_back({port.type, output_topic("robot", name, port.type),
                              effective_qos("", port.type), port.rate});
  }
  return config;
}

[[nodiscard]] inline ServiceConfig stranger(const std::string& name, const std::string& topic,
                                            const std::string& qos = "best_effort",
                                            std::vector<std::string> program = {}) {
  ServiceConfig config = service(name, external_kind());
  config.outputs = {{"scan", topic, qos}};
  config.program = std::move(program);
  return config;
}

[[nodiscard]] inline Deployment deployment(std::vector<ServiceConfig> services) {
  Deployment deployment;
  deployment.file = "/robots/robot.yaml";
  deployment.name_space = "robot";
  deployment.services = std::move(services);
  return deployment;
}

}  // namespace quoin::deploy
