// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "sensor_bridge/replay/kind.hpp"
#include "sensor_bridge/replay/message_replay.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::string file;
  bool json = false;
};

Json describe(const Deployment& deployment) {
  Json services = Json::array();
  for (const ServiceConfig& service : deployment.services) {
    Json parameters = Json::object();
    for (const ParameterSetting& setting : service.parameters)
      parameters[setting.name] = setting.text;
    Json inputs = Json::object();
    for (const InputConfig& input : service.inputs) {
      inputs[input.port.empty() ? input.service : input.port] = input.service;
    }
    Json outputs = Json::array();
    for (const OutputConfig& output : service.outputs) {
      outputs.push_back({{"type", output.type}, {"topic", output.topic}, {"qos", output.qos}});
    }
    const bool one = service.outputs.size() == 1;
    services.push_back({{"name", label(service)},
                        {"kind", service.kind},
                        {"input", service.inputs.size() == 1 ? service.inputs.front().service : ""},
                        {"inputs", inputs},
                        {"method", service.method},
                        {"qos", one ? service.outputs.front().qos : service.qos},
                        {"host", service.host},
                        {"process", process_name(service)},
                        {"restart", service.restart == RestartPolicy::always ? "always" : "never"},
                        {"topic", one ? service.outputs.front().topic : ""},
                        {"outputs", outputs},
                        {"parameters", parameters}});
  }
  return {{"valid", true},
          {"namespace", deployment.name_space},
          {"domain", deployment.domain},
          {"services", services}};
}

void print(const Deployment& deployment) {
  std::cout << deployment.file.string() << ": valid; " << deployment.services.size()
            << (deployment.services.size() == 1 ? " service" : " services") << " in domain "
            << deployment.domain << '\n';
  for (const ServiceConfig& service : deployment.services) {
    std::cout << "  " << label(service) << ": " << service.kind;
    if (!service.method.empty()) std::cout << '/' << service.method;
    if (!service.host.empty()) std::cout << " on " << service.host;
    if (!service.process.empty()) std::cout << " in process " << service.process;
    std::string reads;
    for (const InputConfig& input : service.inputs) {
      reads += (reads.empty() ? " reads " : ", ") + input.service;
      if (service.inputs.size() > 1 && !input.port.empty()) reads += " as " + input.port;
    }
    std::string publishes;
    for (const OutputConfig& output : service.outputs) {
      publishes +=
          (publishes.empty() ? ", publishes " : ", ") + output.topic + " (" + output.qos + ")";
    }
    std::cout << reads << (publishes.empty() ? ", publishes nothing" : publishes) << '\n';
  }
}

/// What `kind: replay` is to play must be there. Throws DeploymentError.
void check_recordings(const Deployment& deployment) {
  std::vector<std::string> errors;
  for (const ServiceConfig& service : deployment.services) {
    if (service.info != &sensor_bridge::replay_kind()) continue;
    try {
      const auto parameters = make_parameters<sensor_bridge::ReplayParameters>(service.parameters);
      const std::filesystem::path folder = deployment.file.parent_path();
      if (sensor_bridge::replays_messages(parameters)) {
        (void)sensor_bridge::open_message_replay(parameters, folder);
        continue;
      }
      sensor_bridge::ScanFiles files = sensor_bridge::open_scan_files(parameters, folder);
      sensor_bridge::RecordedScan scan;
      (void)files.next(scan);
    } catch (const std::exception& error) {
      errors.push_back(deployment.file.string() + ":" + std::to_string(service.position.line) +
                       ":" + std::to_string(service.position.column) + ": service '" +
                       service.name + "': " + error.what());
    }
  }
  if (!errors.empty()) throw DeploymentError(std::move(errors));
}

int run(const CheckOptions& options) {
  try {
    const Deployment deployment = load_deployment(options.file);
    check_recordings(deployment);
    if (options.json) {
      std::cout << describe(deployment).dump(2) << '\n';
    } else {
      print(deployment);
    }
    return exit_ok;
  } catch (const DeploymentError& error) {
    if (!options.json) throw;
    const Json object{{"valid", false}, {"errors", error.messages()}};
    std::cout << object.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    return exit_configuration;
  }
}

}  // namespace

Command add_check(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("check", "Check a deployment file and tell everything wrong with it");
  const auto options = std::make_shared<CheckOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_flag("--json", options->json, "As a JSON object");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
