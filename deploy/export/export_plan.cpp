// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/export_plan.hpp"

#include <algorithm>
#include <map>

#include "deploy/kinds/kinds.hpp"
#include "sensor_bridge/rplidar/service/parameters.hpp"
#include "sensor_bridge/transport/endpoint.hpp"
#include "services/deployment/graph.hpp"

namespace quoin::deploy {

namespace {

/// Names of services and processes have no '-' in them.
std::string id_of(const ServiceConfig& service) {
  std::string id = process_name(service);
  std::ranges::replace(id, '@', '-');
  return id;
}

void look_at_device(const ServiceConfig& config, ExportedProcess& process) {
  using namespace sensor_bridge;
  using namespace sensor_bridge::rplidar;
  if (config.kind == "rplidar_emulator") process.own_network = true;
  if (config.kind != "rplidar") return;
  const std::string port = make_parameters<RplidarParameters>(config.parameters).serial_port;
  if (port == "auto" || parse_endpoint(port).kind == Endpoint::Kind::serial) {
    process.serial_port = port;
  } else {
    process.own_network = true;
  }
}

}  // namespace

std::vector<std::string> ExportedProcess::arguments(const std::filesystem::path& file) const {
  if (!command.empty()) return {command.begin() + 1, command.end()};
  if (!runs_services()) return {"discovery", file.string()};
  return {"--deployment", file.string(), composed ? "--process" : "--service", name};
}

namespace {

ExportedProcess export_process(const ProcessConfig& process) {
  const ServiceConfig& first = *process.services.front();
  ExportedProcess exported;
  exported.name = process.name;
  exported.id = id_of(first);
  exported.composed = !first.process.empty();
  exported.restart = first.restart;
  if (first.external()) {
    exported.command = first.program;
    exported.program = first.program.front();
  } else {
    exported.program = exported.composed ? process_program() : first.info->program;
  }
  exported.kind = first.kind;
  if (exported.composed) {
    exported.kind.clear();
    for (const ServiceConfig* service : process.services) {
      exported.kind += (exported.kind.empty() ? "" : ", ") + label(*service);
    }
  }
  for (const ServiceConfig* service : process.services) {
    if (service->is_source() && !service->external() && service->kind != "rplidar") {
      exported.may_finish = true;
    }
    look_at_device(*service, exported);
  }
  return exported;
}

/// Adds an id once.
void add_after(const std::string& id, ExportedProcess& exported) {
  if (id == exported.id || std::ranges::find(exported.after, id) != exported.after.end()) return;
  exported.after.push_back(id);
}

}  // namespace

ExportPlan plan_export(const Deployment& deployment, const std::string& host,
                       bool discovery_servers) {
  ExportPlan plan;
  plan.deployment = &deployment;
  plan.file = std::filesystem::absolute(deployment.file).lexically_normal();
  plan.id = "quoin-" + deployment.name_space;
  std::ranges::replace(plan.id, '/', '-');
  if (discovery_servers) {
    ExportedProcess servers;
    servers.name = "discovery";
    servers.id = "discovery-server";  // no service is called like this
    servers.kind = "discovery";
    servers.program = "quoin";
    plan.processes.push_back(servers);
  }
  const Graph graph(deployment);
  std::map<std::string, int> levels;  // by id
  std::vector<std::string> devices;
  const std::vector<ProcessConfig> processes = processes_of(deployment);
  for (const ProcessConfig& process : processes) {
    for (const ServiceConfig* service : process.services) {
      if (service->host == host && service->info->exclusive) devices.push_back(id_of(*service));
    }
    levels[id_of(*process.services.front())] = graph.level(process);
  }
  for (const ProcessConfig& process : processes) {
    if (process.services.front()->host != host) continue;
    ExportedProcess exported = export_process(process);
    if (discovery_servers) exported.after.emplace_back("discovery-server");
    for (const ServiceConfig* service : process.services) {
      for (const ServiceConfig* reader : graph.readers_of(service->name)) {
        if (reader->host != host || !reader->has_process()) continue;
        // Two processes that read each other have no order but this.
        if (levels[id_of(*reader)] > levels[exported.id]) add_after(id_of(*reader), exported);
      }
      if (!service->is_source() || service->external()) continue;
      for (const std::string& device : devices) add_after(device, exported);
    }
    plan.processes.push_back(std::move(exported));
  }
  return plan;
}

}  // namespace quoin::deploy
