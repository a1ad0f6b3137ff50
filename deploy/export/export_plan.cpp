// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/export_plan.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/methods/suggestion.hpp"
#include "deploy/deployment/kinds.hpp"
#include "sensor_bridge/rplidar/parameters.hpp"
#include "sensor_bridge/rplidar/transport/endpoint.hpp"

namespace quoin::deploy {

namespace {

void check_host(const Deployment& deployment, const std::string& host) {
  std::vector<std::string> hosts;
  for (const ServiceConfig& service : deployment.services) {
    if (service.host == host) return;
    if (std::ranges::find(hosts, service.host) == hosts.end()) hosts.push_back(service.host);
  }
  const std::string file = deployment.file.string();
  if (host.empty()) {
    std::string names;
    for (const std::string& name : hosts) names += (names.empty() ? "" : ", ") + name;
    throw std::out_of_range(file + ": the services run on several hosts; name one with --host (" +
                            names + ")");
  }
  if (hosts == std::vector<std::string>{""}) {
    throw std::out_of_range(file + ": no service has a host; leave --host out");
  }
  throw std::out_of_range(file + ": no service on host '" + host + "'" + suggestion(host, hosts));
}

/// Names of services have no '-' in them.
std::string id_of(const ServiceConfig& service) {
  std::string id = label(service);
  std::ranges::replace(id, '@', '-');
  return id;
}

void look_at_device(ExportedService& service) {
  using namespace sensor_bridge::rplidar;
  if (service.config->kind == "rplidar_emulator") service.own_network = true;
  if (service.config->kind != "rplidar") return;
  const std::string port =
      make_parameters<RplidarParameters>(service.config->parameters).serial_port;
  if (port == "auto" || parse_endpoint(port).kind == Endpoint::Kind::serial) {
    service.serial_port = port;
  } else {
    service.own_network = true;
  }
}

}  // namespace

ExportPlan plan_export(const Deployment& deployment, const std::string& host) {
  check_host(deployment, host);
  ExportPlan plan;
  plan.deployment = &deployment;
  plan.file = std::filesystem::absolute(deployment.file).lexically_normal();
  plan.id = "quoin-" + deployment.name_space;
  std::ranges::replace(plan.id, '/', '-');
  std::vector<std::string> devices;
  for (const ServiceConfig& service : deployment.services) {
    if (service.host == host && find_kind(service.kind)->output == MessageType::none) {
      devices.push_back(id_of(service));
    }
  }
  for (const ServiceConfig& service : deployment.services) {
    if (service.host != host) continue;
    const KindInfo& kind = *find_kind(service.kind);
    ExportedService exported;
    exported.config = &service;
    exported.label = label(service);
    exported.id = id_of(service);
    exported.program = kind.program;
    for (const ServiceConfig* reader : deployment.readers_of(service.name)) {
      if (reader->host == host) exported.after.push_back(id_of(*reader));
    }
    if (kind.input == MessageType::none && kind.output != MessageType::none) {
      exported.after.insert(exported.after.end(), devices.begin(), devices.end());
      exported.may_finish = service.kind != "rplidar";
    }
    look_at_device(exported);
    plan.services.push_back(std::move(exported));
  }
  return plan;
}

}  // namespace quoin::deploy
