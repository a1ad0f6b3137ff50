// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/launch.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "services/deployment/graph.hpp"
#include "services/keys/key_check.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/interfaces.hpp"

namespace quoin::deploy {

std::filesystem::path program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

bool serves_discovery(const Deployment& deployment) {
  const NetworkConfig& network = deployment.network;
  if (network.discovery != Discovery::server) return false;
  const auto addresses = runtime::resolve_interfaces(network.interfaces, runtime::host_addresses());
  return !runtime::servers_here(network, addresses).empty();
}

namespace {

// [s] Readers that live are found again in less. While it waits for others a process does nothing
// for those either.
constexpr auto patience_of_a_restart = "2";
constexpr auto patience_of_a_secured_restart = "6";

/// Nothing when no server of the deployment is on this host.
std::optional<ProcessPlan> discovery_plan(const Deployment& deployment,
                                          const std::filesystem::path& file) {
  if (!serves_discovery(deployment)) return std::nullopt;
  ProcessPlan plan;
  plan.name = discovery_process;
  plan.program = std::filesystem::read_symlink("/proc/self/exe");  // it knows the same kinds
  plan.arguments = {"discovery", std::filesystem::absolute(file).string()};
  plan.level = std::numeric_limits<int>::max();  // others are found until the end
  plan.least_pause = discovery_pause(deployment.network);
  return plan;
}

}  // namespace

std::vector<ProcessPlan> process_plans(const Deployment& deployment, const std::string& host,
                                       const std::function<int(const ServiceConfig&)>& observers,
                                       const std::filesystem::path& copy) {
  const std::filesystem::path folder = program_folder();
  std::vector<std::string> identities{std::string(operator_identity)};
  for (const ServiceConfig& service : deployment.services) {
    if (service.host == host && !service.external()) identities.push_back(label(service));
  }
  require_keys(deployment, identities);
  const Graph graph(deployment);
  std::vector<ProcessPlan> plans;
  std::vector<std::size_t> behind;
  int last_level = 0;
  for (const ServiceConfig& service : deployment.services) {
    if (service.host != host || !service.has_process()) continue;
    ProcessPlan plan;
    plan.name = label(service);
    plan.level = graph.level(service);
    plan.restart = service.restart == RestartPolicy::always;
    if (service.external()) {
      plan.program = service.program.front();
      plan.arguments.assign(service.program.begin() + 1, service.program.end());
      plans.push_back(std::move(plan));
      continue;
    }
    plan.program = folder / service.info->program;
    if (::access(plan.program.c_str(), X_OK) != 0) {
      throw std::runtime_error(plan.program.string() + " is missing or not executable; service '" +
                               service.name + "' of kind " + service.kind + " needs it");
    }
    const std::string file = std::filesystem::absolute(deployment.file).string();
    plan.arguments = {"--service", plan.name, "--deployment"};
    if (copy.empty()) {
      plan.arguments.push_back(file);
    } else {
      plan.arguments.insert(plan.arguments.end(), {copy.string(), "--deployment-name", file});
    }
    if (const int count = observers(service); count > 0) {
      plan.arguments.insert(plan.arguments.end(), {"--observers", std::to_string(count)});
    }
    plan.source = service.is_source();
    plan.again = {"--patience",
                  deployment.security ? patience_of_a_secured_restart : patience_of_a_restart};
    if (service.info->exclusive) behind.push_back(plans.size());
    last_level = std::max(last_level, plan.level);
    plans.push_back(std::move(plan));
  }
  // A device is there for the others, and stops when they have.
  for (const std::size_t index : behind) plans[index].level = last_level + 1;
  if (auto discovery = discovery_plan(deployment, copy.empty() ? deployment.file : copy))
    plans.push_back(std::move(*discovery));
  return plans;
}

}  // namespace quoin::deploy
