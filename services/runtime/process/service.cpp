// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/service.hpp"

#include <exception>
#include <optional>

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "core/parameters/parameter.hpp"

namespace quoin::runtime {

namespace {

const ServiceConfig& find_service(const Deployment& deployment, const std::string& name,
                                  const std::string& kind) {
  std::vector<std::string> candidates;
  for (const ServiceConfig& service : deployment.services) {
    if (service.kind != kind) continue;
    if (label(service) == name) return service;
    candidates.push_back(label(service));
  }
  throw DeploymentError({deployment.file.string() + ": no service '" + name + "' of kind " + kind +
                         suggestion(name, candidates)});
}

// [s] Each pair of participants has to shake hands first, which takes ten of them that start at
// once on a busy machine many seconds.
double default_patience(const Deployment& deployment) { return deployment.security ? 30.0 : 10.0; }

/// An observer announces what it observes: who begins to write waits for it.
ParticipantConfig participant_of(const Deployment& deployment, const ServiceConfig& config,
                                 const Graph& graph) {
  ParticipantConfig participant = participant_config(deployment, label(config));
  if (!config.info->observer) return participant;
  for (const Connection& input : graph.inputs_of(config)) {
    participant.observes.push_back(input.output.topic);
  }
  return participant;
}

}  // namespace

Service::Service(StopSignal& stop_signal, const Deployment& deployment_file,
                 const ServiceConfig& service_config, std::size_t observers,
                 std::chrono::duration<double> patience_with_readers, bool to_take_over)
    : stop(stop_signal),
      deployment(deployment_file),
      config(service_config),
      graph(deployment),
      participant(participant_of(deployment, config, graph)),
      record(config),
      heartbeat(participant, deployment.name_space, record),
      expected_readers(graph.expected_readers(config) + observers),
      patience(patience_with_readers),
      held(to_take_over) {}

bool Service::wait_for_readers(const std::vector<const Output*>& outputs,
                               const Succession& succession) {
  using std::chrono::milliseconds;
  using std::chrono::steady_clock;
  const auto matched = [&] {
    std::size_t sum = 0;
    for (const Output* output : outputs) sum += output->matched();
    return sum;
  };
  const auto observers = [&] {
    std::vector<std::string> all;
    for (const Output* output : outputs) {
      for (std::string& name : output->awaited_observers()) all.push_back(std::move(name));
    }
    return all;
  };
  if (outputs.empty()) return !stop.requested();
  record.set_state(msg::ServiceState::STATE_STARTING,
                   "waiting for " + std::to_string(expected_readers) + " readers");
  const auto deadline =
      steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(patience);
  while (matched() < expected_readers || !participant.discovery_settled() || !observers().empty()) {
    if (!stop.wait_until(steady_clock::now() + milliseconds(5))) return false;
    if (!succession.held() && steady_clock::now() > deadline) {
      std::string names;
      for (const std::string& name : observers()) names += ", without " + name;
      spdlog::warn("only {} of {} readers are there after {} s{}; going on without the others",
                   matched(), expected_readers, patience.count(), names);
      break;
    }
  }
  return !stop.requested();
}

std::vector<Node::OutputPart> make_outputs(Service& service, const KindInfo& kind,
                                           const PortTypes& types) {
  std::vector<Node::OutputPart> parts;
  for (std::size_t i = 0; i < kind.outputs.size(); ++i) {
    const OutputConfig& output = service.config.outputs[i];
    const TopicQos qos = output_qos(service.config, output);
    parts.push_back({kind.outputs[i], output.topic, qos.preset == QosPreset::lossless,
                     types.outputs[i](service.participant, output.topic, qos)});
  }
  return parts;
}

int run_service(int argc, char** argv, const KindInfo& kind,
                const std::function<void(const Deployment&, const ServiceConfig&)>& check,
                const std::function<int(Service&)>& run) {
  CLI::App app{"Quoin service of kind " + kind.name + ", as described in a deployment file"};
  std::string deployment_file;
  std::string service_name;
  std::string deployment_name;
  std::size_t observers = 0;
  std::optional<double> patience;
  bool held = false;
  app.add_option("--deployment", deployment_file, "Deployment file (YAML)")->required();
  app.add_option("--service", service_name, "Name of this service in it")->required();
  app.add_option("--observers", observers,
                 "Readers outside the deployment to wait for before the first scan");
  app.add_option("--patience", patience,
                 "Seconds to wait for readers before going on without them (10, with security 30)")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--deployment-name", deployment_name,
                 "What the deployment file is a copy of: messages name that, and paths in it count "
                 "from its folder");
  app.add_flag("--held", held,
               "Take over from a running process of this service when asked to; publish nothing "
               "before");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_configuration;
  }

  spdlog::set_default_logger(spdlog::stderr_color_mt(service_name));
  spdlog::set_pattern("%H:%M:%S.%e [%n] %^%l%$ %v");
  try {
    StopSignal stop;
    if (deployment_name.empty()) deployment_name = deployment_file;
    const Deployment deployment =
        parse_deployment(read_deployment(deployment_file), deployment_name, {{&kind}, false});
    const ServiceConfig& config = find_service(deployment, service_name, kind.name);
    check(deployment, config);
    Service service(stop, deployment, config, observers,
                    std::chrono::duration<double>(patience.value_or(default_patience(deployment))),
                    held);
    return run(service);
  } catch (const DeploymentError& error) {
    for (const std::string& message : error.messages()) spdlog::error("{}", message);
    return exit_configuration;
  } catch (const ParameterError& error) {
    spdlog::error("{}: parameter '{}': {}", deployment_name, error.parameter(), error.what());
    return exit_configuration;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return exit_failure;
  }
}

}  // namespace quoin::runtime
