// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/deployment.hpp"

#include <algorithm>

#include "core/parameters/parameter.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin {

namespace {
std::string joined(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& message : messages) text += (text.empty() ? "" : "\n") + message;
  return text;
}
}  // namespace

DeploymentError::DeploymentError(std::vector<std::string> messages)
    : std::runtime_error(joined(messages)), messages_(std::move(messages)) {}

std::string label(const ServiceConfig& service) {
  return service.strength ? service.name + "@" + std::to_string(*service.strength) : service.name;
}

std::string process_name(const ServiceConfig& service) {
  return service.process.empty() ? label(service) : service.process;
}

std::vector<ProcessConfig> processes_of(const Deployment& deployment) {
  std::vector<ProcessConfig> processes;
  for (const ServiceConfig& service : deployment.services) {
    if (!service.has_process()) continue;
    const std::string name = process_name(service);
    auto process = std::ranges::find(processes, name, &ProcessConfig::name);
    if (process == processes.end()) process = processes.insert(process, {name, {}});
    process->services.push_back(&service);
  }
  return processes;
}

bool share_memory(const ServiceConfig& writer, const ServiceConfig& reader) {
  const bool observer = reader.info != nullptr && reader.info->observer;
  return !writer.process.empty() && writer.process == reader.process && !writer.strength &&
         !observer;
}

const ServiceConfig& Deployment::service(std::string_view name) const {
  const auto found = std::find_if(services.begin(), services.end(), [&](const ServiceConfig& s) {
    return s.name == name || label(s) == name;
  });
  if (found == services.end()) {
    std::vector<std::string> names;
    for (const ServiceConfig& s : services) names.push_back(label(s));
    throw std::out_of_range(file.string() + ": no service '" + std::string(name) + "'" +
                            suggestion(name, names));
  }
  return *found;
}

const OutputConfig* ServiceConfig::output(std::string_view type) const {
  const auto found = std::find_if(outputs.begin(), outputs.end(),
                                  [&](const OutputConfig& output) { return output.type == type; });
  return found == outputs.end() ? nullptr : &*found;
}

std::string_view ServiceConfig::input(std::string_view port) const {
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [&](const InputConfig& input) { return input.port == port; });
  return found == inputs.end() ? std::string_view() : found->service;
}

std::chrono::milliseconds discovery_pause(const NetworkConfig& network) {
  return std::chrono::milliseconds(static_cast<int>(network.lease * 1000.0) + 1000);
}

std::vector<std::string> hosts_of(const Deployment& deployment) {
  std::vector<std::string> hosts;
  for (const ServiceConfig& service : deployment.services) {
    if (service.host.empty()) continue;
    if (std::find(hosts.begin(), hosts.end(), service.host) == hosts.end()) {
      hosts.push_back(service.host);
    }
  }
  return hosts;
}

std::string output_topic(std::string_view name_space, std::string_view name,
                         std::string_view type) {
  return std::string(name_space) + "/" + std::string(name) + "/" + std::string(type);
}

std::string effective_qos(std::string_view wanted, std::string_view type) {
  const topics::TopicType* known = topics::find_topic_type(type);
  const std::string_view usual = known == nullptr ? "feature" : known->qos;
  return std::string(wanted.empty() || usual == "state" ? usual : wanted);
}

std::string status_topic(std::string_view name_space) {
  return std::string(name_space) + "/status";
}

std::string control_request_topic(std::string_view name_space) {
  return std::string(name_space) + "/control/request";
}

std::string supervisor_name(std::string_view host) { return "@" + std::string(host); }

std::string control_reply_topic(std::string_view name_space) {
  return std::string(name_space) + "/control/reply";
}

}  // namespace quoin
