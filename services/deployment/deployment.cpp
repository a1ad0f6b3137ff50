// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/deployment.hpp"

#include <algorithm>

#include "services/deployment/kinds.hpp"

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

std::vector<const ServiceConfig*> Deployment::readers_of(std::string_view name) const {
  std::vector<const ServiceConfig*> readers;
  for (const ServiceConfig& s : services) {
    if (s.input == name) readers.push_back(&s);
  }
  return readers;
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

std::string output_topic(const Deployment& deployment, const ServiceConfig& service) {
  const KindInfo* kind = find_kind(service.kind);
  if (kind == nullptr) throw std::invalid_argument("unknown kind '" + service.kind + "'");
  if (kind->output == MessageType::none) return "";
  return deployment.name_space + "/" + service.name + "/" + std::string(message_name(kind->output));
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
