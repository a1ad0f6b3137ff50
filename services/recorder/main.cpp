// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/deployment/graph.hpp"
#include "services/recorder/heartbeat_feed.hpp"
#include "services/recorder/kind.hpp"
#include "services/recorder/recorder.hpp"
#include "services/runtime/process/run_node.hpp"
#include "services/runtime/process/service.hpp"

using namespace quoin;

namespace {

runtime::Component::Body open(const Deployment& deployment, const ServiceConfig& config) {
  const auto parameters = make_parameters<RecorderParameters>(config.parameters);
  std::map<std::string, std::size_t> numbers;
  std::vector<RecordedTopic> topics;
  for (const Connection& input : Graph(deployment).inputs_of(config)) {
    numbers[input.output.topic] = topics.size();
    topics.push_back({input.output.topic, input.writer->name,
                      topics::find_topic_type(input.output.type), input.output.qos});
  }
  const auto recorder = std::make_shared<Recorder>(
      deployment.file.parent_path() / parameters.path, parameters, std::move(topics),
      run_facts(deployment), status_topic(deployment.name_space));
  const auto handle = [recorder, numbers = std::move(numbers)](runtime::Work& work) {
    const auto& message = work.input<runtime::ObservedMessage>();
    recorder->record(numbers.at(message.topic), message.raw, message.header);
    for (const auto& [name, value] : recorder->diagnostics()) work.set_diagnostic(name, value);
  };
  const auto node = std::make_shared<runtime::Component>(runtime::node_component(
      recorder_kind(), runtime::port_types(runtime::Reads<>(), runtime::Writes<>()),
      [handle](const std::string&, const ParameterSettings&) {
        return runtime::Method{.handle = handle};
      }));
  return [recorder, node, body = node->open(deployment, config),
          name_space = deployment.name_space](runtime::Service& service) {
    std::optional<HeartbeatFeed> heartbeats;
    heartbeats.emplace(service.process.participant, name_space, *recorder);
    const int code = body(service);
    heartbeats.reset();
    recorder->finish();
    return code;
  };
}

const runtime::Registration registration({&recorder_kind(), open});

}  // namespace
