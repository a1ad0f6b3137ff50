// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/service.hpp"

#include <utility>

#include <spdlog/spdlog.h>

#include "services/runtime/dds/process_writers.hpp"

namespace quoin::runtime {

namespace {

/// Observers announce what they observe: who begins to write waits for them.
ParticipantConfig participant_of(const Deployment& deployment, const std::string& name,
                                 const std::vector<const ServiceConfig*>& services,
                                 const Graph& graph, std::string user_data) {
  ParticipantConfig participant = participant_config(deployment, name);
  participant.user_data = std::move(user_data);
  for (const ServiceConfig* service : services) {
    if (!service->info->observer) continue;
    for (const Connection& input : graph.inputs_of(*service)) {
      participant.observes.push_back(input.output.topic);
    }
  }
  return participant;
}

}  // namespace

Process::Process(const Deployment& deployment, const std::string& name,
                 const std::vector<const ServiceConfig*>& services,
                 std::chrono::duration<double> wait_for_readers, bool to_take_over,
                 std::string user_data)
    : graph(deployment),
      participant(participant_of(deployment, name, services, graph, std::move(user_data))),
      heartbeat(participant, deployment.name_space),
      control(participant, deployment.name_space),
      longest_wait_for_readers(wait_for_readers),
      held(to_take_over) {}

Service::Service(Process& process_of_it, const ServiceConfig& service_config, std::size_t observers)
    : process(process_of_it),
      config(service_config),
      record(config),
      expected_readers(process.graph.expected_readers(config) + observers) {
  process.heartbeat.add(record, pulse);
}

Service::Answering::Answering(Service& service, Succession& succession,
                              ControlTarget::Handler handler)
    : service_(service) {
  service_.process.control.add({.name = service_.config.name,
                                .label = label(service_.config),
                                .record = &service_.record,
                                .stop = &service_.stop,
                                .succession = &succession,
                                .handler = std::move(handler)});
}

Service::Answering::~Answering() { service_.process.control.remove(label(service_.config)); }

bool Service::wait_for_readers(const std::vector<Node::OutputPart>& outputs,
                               const Succession& succession) {
  using std::chrono::milliseconds;
  using std::chrono::steady_clock;
  const auto matched = [&] {
    std::size_t sum = 0;
    for (const Node::OutputPart& part : outputs) sum += part.output->matched();
    return sum;
  };
  const auto observers = [&] {
    std::vector<std::string> all;
    for (const Node::OutputPart& part : outputs) {
      for (std::string& observer : part.output->awaited_observers()) {
        all.push_back(std::move(observer));
      }
    }
    return all;
  };
  if (outputs.empty()) return !stop.requested();
  record.set_state(msg::ServiceState::STATE_STARTING,
                   "waiting for " + std::to_string(expected_readers) + " readers");
  const auto deadline = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(
                                                  process.longest_wait_for_readers);
  while (matched() < expected_readers || !process.participant.discovery_complete() ||
         !observers().empty()) {
    if (!stop.wait_until(steady_clock::now() + milliseconds(5))) return false;
    if (!succession.held() && steady_clock::now() > deadline) {
      std::string names;
      for (const std::string& observer : observers()) names += ", without " + observer;
      spdlog::warn("only {} of {} readers are there after {} s{}; going on without the others",
                   matched(), expected_readers, process.longest_wait_for_readers.count(), names);
      break;
    }
  }
  return !stop.requested();
}

std::vector<Node::OutputPart> make_outputs(Service& service, const KindInfo& kind,
                                           const PortTypes& types) {
  std::vector<Node::OutputPart> parts;
  for (std::size_t i = 0; i < kind.outputs.size(); ++i) {
    const OutputConfig* const found = service.config.output(kind.outputs[i].type);
    if (found == nullptr) continue;
    const OutputConfig& output = *found;
    TopicQos qos = output_qos(service.config, output);
    qos.user_data = writer_announcement(service.record.incarnation());
    std::shared_ptr<LocalTopic> neighbours;
    if (!service.config.process.empty() && !service.config.strength) {
      neighbours = service.process.topics.topic(output.topic);
      neighbours->open(service.record.incarnation());
    }
    parts.push_back(
        {kind.outputs[i], output.topic, qos.preset == QosPreset::lossless,
         types.outputs[i](service.process.participant, output.topic, qos, std::move(neighbours))});
  }
  return parts;
}

}  // namespace quoin::runtime
