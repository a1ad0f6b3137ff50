// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <stdexcept>

#include "services/ros2/topics.hpp"
#include "services/ros2_output/heartbeat_relay.hpp"
#include "services/ros2_output/kind.hpp"
#include "services/ros2_output/publisher.hpp"
#include "services/runtime/process/run_node.hpp"

using namespace quoin;

namespace {

void report(const Ros2Publisher& publisher, runtime::Work& work) {
  for (const auto& [topic, count] : publisher.counts()) {
    work.set_diagnostic(topic, std::to_string(count.written) +
                                   " written, readers: " + std::to_string(count.readers));
  }
}

runtime::BindMethods open(const Deployment& deployment, const ServiceConfig& config) {
  const auto parameters = make_parameters<Ros2OutputParameters>(config.parameters);
  ros2::check_topic(deployment, "prefix",
                    parameters.prefix.empty() ? deployment.name_space : parameters.prefix);
  return [&deployment, &config, parameters](runtime::Participant& participant) {
    const auto publisher =
        std::make_shared<Ros2Publisher>(participant, deployment, config, parameters);
    const auto relay =
        parameters.diagnostics
            ? std::make_shared<HeartbeatRelay>(participant, label(config), deployment.name_space)
            : nullptr;
    return [publisher, relay](const std::string&, const ParameterSettings&) -> runtime::Method {
      return {.handle = [publisher, relay, next = std::chrono::steady_clock::time_point()](
                            runtime::Work& work) mutable {
        const auto& observed = work.input<runtime::ObservedMessage>();
        if (!publisher->handle(observed.topic, observed.raw)) {
          throw std::invalid_argument("no message of type " + observed.type);
        }
        const auto now = std::chrono::steady_clock::now();
        if (now < next) return;
        next = now + std::chrono::seconds(1);
        report(*publisher, work);
      }};
    };
  };
}

const runtime::Registration registration(runtime::node_component(
    ros2_output_kind(), runtime::port_types(runtime::Reads<>(), runtime::Writes<>()),
    runtime::OpenMethods(open)));

}  // namespace
