// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/export_plan.hpp"

#include <algorithm>

#include "sensor_bridge/rplidar/service/parameters.hpp"
#include "sensor_bridge/transport/endpoint.hpp"
#include "services/deployment/graph.hpp"

namespace quoin::deploy {

namespace {

/// Names of services have no '-' in them.
std::string id_of(const ServiceConfig& service) {
  std::string id = label(service);
  std::ranges::replace(id, '@', '-');
  return id;
}

void look_at_device(const ServiceConfig& config, ExportedService& service) {
  using namespace sensor_bridge;
  using namespace sensor_bridge::rplidar;
  if (config.kind == "rplidar_emulator") service.own_network = true;
  if (config.kind != "rplidar") return;
  const std::string port = make_parameters<RplidarParameters>(config.parameters).serial_port;
  if (port == "auto" || parse_endpoint(port).kind == Endpoint::Kind::serial) {
    service.serial_port = port;
  } else {
    service.own_network = true;
  }
}

}  // namespace

std::vector<std::string> ExportedService::arguments(const std::filesystem::path& file) const {
  if (!command.empty()) return {command.begin() + 1, command.end()};
  if (!is_service()) return {"discovery", file.string()};
  return {"--deployment", file.string(), "--service", label};
}

ExportPlan plan_export(const Deployment& deployment, const std::string& host,
                       bool discovery_servers) {
  ExportPlan plan;
  plan.deployment = &deployment;
  plan.file = std::filesystem::absolute(deployment.file).lexically_normal();
  plan.id = "quoin-" + deployment.name_space;
  std::ranges::replace(plan.id, '/', '-');
  if (discovery_servers) {
    ExportedService servers;
    servers.label = "discovery";
    servers.id = "discovery-server";  // no service is called like this
    servers.kind = "discovery";
    servers.program = "quoin";
    plan.services.push_back(servers);
  }
  const Graph graph(deployment);
  std::vector<std::string> devices;
  for (const ServiceConfig& service : deployment.services) {
    if (service.host == host && service.info->exclusive) devices.push_back(id_of(service));
  }
  for (const ServiceConfig& service : deployment.services) {
    if (service.host != host || !service.has_process()) continue;
    ExportedService exported;
    exported.kind = service.kind;
    exported.restart = service.restart;
    exported.label = label(service);
    exported.id = id_of(service);
    if (service.external()) {
      exported.command = service.program;
      exported.program = service.program.front();
    } else {
      exported.program = service.info->program;
    }
    if (discovery_servers) exported.after.emplace_back("discovery-server");
    for (const ServiceConfig* reader : graph.readers_of(service.name)) {
      if (reader->host == host && reader->has_process()) exported.after.push_back(id_of(*reader));
    }
    if (service.is_source() && !service.external()) {
      exported.after.insert(exported.after.end(), devices.begin(), devices.end());
      exported.may_finish = service.kind != "rplidar";
    }
    look_at_device(service, exported);
    plan.services.push_back(std::move(exported));
  }
  return plan;
}

}  // namespace quoin::deploy
