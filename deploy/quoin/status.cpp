// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <idl/Status.h>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "deploy/deployment/deployment.hpp"
#include "deploy/keys/key_files.hpp"
#include "deploy/quoin/commands.hpp"
#include "deploy/quoin/monitor.hpp"
#include "deploy/quoin/network_options.hpp"
#include "deploy/report/summary.hpp"
#include "deploy/report/table.hpp"
#include "services/runtime/participant.hpp"
#include "services/runtime/reader.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct StatusOptions {
  std::string file;
  NetworkOptions network;
  double wait = 2.0;  // [s]
  bool json = false;
};

using Heartbeats = std::map<std::string, msg::ServiceStatus>;

/// The newest heartbeat of each service; returns early once all of the deployment have been heard.
Heartbeats collect(const Deployment& deployment, double wait) {
  runtime::Participant participant(
      runtime::participant_config(deployment, "quoin_status", observer_identity));
  runtime::Reader<msg::ServiceStatus> reader(participant, status_topic(deployment.name_space),
                                             runtime::QosPreset::state);
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  Heartbeats heartbeats;
  const auto complete = [&] {
    for (const ServiceConfig& service : deployment.services) {
      if (!heartbeats.contains(service.name)) return false;
    }
    return !deployment.services.empty();
  };
  msg::ServiceStatus status;
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(wait));
  while (!complete() && Clock::now() < deadline) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
    wait_set.wait(std::min(left, milliseconds(100)));
    while (reader.take(status)) {
      msg::ServiceStatus& newest = heartbeats[status.service()];
      if (status.stamp() >= newest.stamp()) newest = status;
    }
  }
  return heartbeats;
}

ServiceFigures figures_of(const msg::ServiceStatus& status) {
  return {status.service(), status.kind(), status.method(), report_of(status), 0};
}

DeploymentFigures figures_of(const Heartbeats& heartbeats, const Deployment& deployment) {
  DeploymentFigures figures;
  if (deployment.services.empty()) {
    for (const auto& [name, status] : heartbeats) figures.services.push_back(figures_of(status));
    return figures;
  }
  for (const ServiceConfig& service : deployment.services) {
    const auto heard = heartbeats.find(service.name);
    if (heard != heartbeats.end()) {
      figures.services.push_back(figures_of(heard->second));
    } else {
      ServiceFigures silent{service.name, service.kind, service.method, {}, 0};
      silent.report.state = "silent";
      figures.services.push_back(silent);
    }
  }
  return figures;
}

void print(const DeploymentFigures& figures, const Heartbeats& heartbeats) {
  for (const std::string& text : table_lines(figures, std::string::npos)) std::cout << text << '\n';
  for (const auto& [name, status] : heartbeats) {
    if (!status.detail().empty()) std::cout << name << ": " << status.detail() << '\n';
    for (const std::string& mismatch : status.incompatible_qos()) {
      std::cout << name << ": incompatible QoS: " << mismatch << '\n';
    }
    for (const msg::Diagnostic& diagnostic : status.diagnostics()) {
      std::cout << name << ": " << diagnostic.name() << ": " << diagnostic.value() << '\n';
    }
  }
}

void print_json(const DeploymentFigures& figures, const Heartbeats& heartbeats) {
  nlohmann::ordered_json services = nlohmann::ordered_json::object();
  for (const ServiceFigures& service : figures.services) {
    auto object = service_summary(service);
    object.erase("restarts");  // known to the supervisor only
    const auto heard = heartbeats.find(service.name);
    if (heard != heartbeats.end()) {
      const msg::ServiceStatus& status = heard->second;
      object["detail"] = status.detail();
      object["rate_hz"] = status.rate();
      object["host"] = status.host();
      object["pid"] = status.pid();
      object["incarnation"] = status.incarnation();
      object["stamp"] = status.stamp();
      object["matched_inputs"] = status.matched_inputs();
      object["matched_outputs"] = status.matched_outputs();
      object["incompatible_qos"] = status.incompatible_qos();
      auto diagnostics = nlohmann::ordered_json::object();
      for (const msg::Diagnostic& diagnostic : status.diagnostics()) {
        diagnostics[diagnostic.name()] = diagnostic.value();
      }
      object["diagnostics"] = diagnostics;
    }
    services[service.name] = object;
  }
  const nlohmann::ordered_json object{{"services", services}};
  std::cout << object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

int run(const StatusOptions& options) {
  const Deployment deployment = deployment_to_reach(options.network, options.file);
  const Heartbeats heartbeats = collect(deployment, options.wait);
  const DeploymentFigures figures = figures_of(heartbeats, deployment);
  if (options.json) {
    print_json(figures, heartbeats);
  } else if (!figures.services.empty()) {
    print(figures, heartbeats);
  }
  if (heartbeats.empty()) {
    std::cerr << "no service of namespace '" << deployment.name_space << "' reports in domain "
              << deployment.domain << "; is it running?\n";
    return exit_failure;
  }
  for (const ServiceFigures& service : figures.services) {
    if (service.report.state == "silent" || service.report.state == "failed") return exit_failure;
  }
  return exit_ok;
}

}  // namespace

Command add_status(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "status",
      "Show what the services of a running deployment report; fails when one is silent or failed");
  const auto options = std::make_shared<StatusOptions>();
  CLI::Option* file = line->add_option("file", options->file, "Deployment file (YAML)");
  add_network_options(*line, options->network, file);
  line->add_option("--wait", options->wait, "How long to listen [s]")
      ->capture_default_str()
      ->check(more_than_zero());
  line->add_flag("--json", options->json, "As a JSON object");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
