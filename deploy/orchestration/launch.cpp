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

#include "deploy/kinds/kinds.hpp"
#include "services/deployment/graph.hpp"
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
constexpr auto timeout_of_a_restart = "2";
constexpr auto timeout_of_a_secured_restart = "6";

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

namespace {

std::filesystem::path program_of(const ProcessConfig& process) {
  const ServiceConfig& first = *process.services.front();
  const std::filesystem::path program =
      program_folder() / (first.process.empty() ? first.info->program : process_program());
  if (::access(program.c_str(), X_OK) != 0) {
    throw std::runtime_error(program.string() + " is missing or not executable; " +
                             (first.process.empty()
                                  ? "service '" + first.name + "' of kind " + first.kind
                                  : "process '" + process.name + "'") +
                             " needs it");
  }
  return program;
}

ProcessPlan plan_of(const Deployment& deployment, const Graph& graph, const ProcessConfig& process,
                    const std::function<int(const ServiceConfig&)>& observers,
                    const std::filesystem::path& copy) {
  const ServiceConfig& first = *process.services.front();
  ProcessPlan plan;
  plan.name = process.name;
  plan.level = graph.level(process);
  plan.restart = first.restart == RestartPolicy::always;
  for (const ServiceConfig* service : process.services) plan.services.push_back(label(*service));
  if (first.external()) {
    plan.program = first.program.front();
    plan.arguments.assign(first.program.begin() + 1, first.program.end());
    return plan;
  }
  plan.program = program_of(process);
  const std::string file = std::filesystem::absolute(deployment.file).string();
  plan.arguments = {first.process.empty() ? "--service" : "--process", plan.name, "--deployment"};
  if (copy.empty()) {
    plan.arguments.push_back(file);
  } else {
    plan.arguments.insert(plan.arguments.end(), {copy.string(), "--deployment-name", file});
  }
  for (const ServiceConfig* service : process.services) {
    if (const int count = observers(*service); count > 0) {
      plan.arguments.insert(plan.arguments.end(),
                            {"--observers", label(*service) + "=" + std::to_string(count)});
    }
    plan.source = plan.source || service->is_source();
  }
  plan.again = {"--reader-timeout",
                deployment.security ? timeout_of_a_secured_restart : timeout_of_a_restart};
  return plan;
}

/// A device that nobody else's process needs to hear before it stops.
bool is_device(const ProcessConfig& process) {
  return std::ranges::all_of(process.services,
                             [](const ServiceConfig* service) { return service->info->exclusive; });
}

}  // namespace

std::vector<ProcessPlan> process_plans(const Deployment& deployment, const std::string& host,
                                       const std::function<int(const ServiceConfig&)>& observers,
                                       const std::filesystem::path& copy) {
  const Graph graph(deployment);
  const std::vector<ProcessConfig> processes = processes_of(deployment);
  std::vector<std::string> identities{std::string(operator_identity)};
  for (const ProcessConfig& process : processes) {
    const ServiceConfig& first = *process.services.front();
    if (first.host == host && !first.external()) identities.push_back(process.name);
  }
  require_keys(deployment, identities);
  std::vector<ProcessPlan> plans;
  std::vector<std::size_t> devices;
  int last_level = 0;
  for (const ProcessConfig& process : processes) {
    if (process.services.front()->host != host) continue;
    ProcessPlan plan = plan_of(deployment, graph, process, observers, copy);
    if (is_device(process)) devices.push_back(plans.size());
    last_level = std::max(last_level, plan.level);
    plans.push_back(std::move(plan));
  }
  // A device is there for the others, and stops when they have.
  for (const std::size_t index : devices) plans[index].level = last_level + 1;
  if (auto discovery = discovery_plan(deployment, copy.empty() ? deployment.file : copy))
    plans.push_back(std::move(*discovery));
  return plans;
}

}  // namespace quoin::deploy
