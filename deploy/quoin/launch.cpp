// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/quoin/launch.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "deploy/deployment/kinds.hpp"

namespace quoin::deploy {

std::filesystem::path program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

std::vector<ProcessPlan> process_plans(const Deployment& deployment,
                                       const std::function<int(const ServiceConfig&)>& observers,
                                       const std::filesystem::path& copy) {
  const std::filesystem::path folder = program_folder();
  std::map<std::string, int> levels;
  std::vector<ProcessPlan> plans;
  std::vector<std::size_t> behind;
  int last_level = 0;
  for (const ServiceConfig& service : deployment.services) {
    ProcessPlan plan;
    plan.name = service.name;
    plan.program = folder / find_kind(service.kind)->program;
    if (::access(plan.program.c_str(), X_OK) != 0) {
      throw std::runtime_error(plan.program.string() + " is missing or not executable; service '" +
                               service.name + "' of kind " + service.kind + " needs it");
    }
    const std::string file = std::filesystem::absolute(deployment.file).string();
    plan.arguments = {"--service", service.name, "--deployment"};
    if (copy.empty()) {
      plan.arguments.push_back(file);
    } else {
      plan.arguments.insert(plan.arguments.end(), {copy.string(), "--deployment-name", file});
    }
    if (const int count = observers(service); count > 0) {
      plan.arguments.insert(plan.arguments.end(), {"--observers", std::to_string(count)});
    }
    const bool publishes = find_kind(service.kind)->output != MessageType::none;
    plan.source = service.input.empty() && publishes;
    plan.level = service.input.empty() ? 0 : levels.at(service.input) + 1;
    plan.restart = service.restart == RestartPolicy::always;
    levels[service.name] = plan.level;
    if (!publishes) behind.push_back(plans.size());
    last_level = std::max(last_level, plan.level);
    plans.push_back(std::move(plan));
  }
  // What publishes nothing is there for the others, and stops when they have.
  for (const std::size_t index : behind) plans[index].level = last_level + 1;
  return plans;
}

}  // namespace quoin::deploy
