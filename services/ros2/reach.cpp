// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/reach.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace quoin::ros2 {

namespace {

// 239.255.0.1, to which all participants of any domain announce themselves (RTPS 2.2, 9.6.1.4), as
// the kernel writes it.
constexpr std::string_view discovery_group = "0100FFEF";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string line_that_mends(const std::vector<std::string>& interfaces) {
  return "network: {interfaces: [" + listed(interfaces) + "], discovery: multicast}";
}

bool on_loopback(const Deployment& deployment) { return deployment.network.interfaces.empty(); }

}  // namespace

Surroundings look_around(const std::filesystem::path& multicast_groups) {
  Surroundings found{.multicast_interfaces = {},
                     .domain_id = variable("ROS_DOMAIN_ID"),
                     .discovery_range = variable("ROS_AUTOMATIC_DISCOVERY_RANGE"),
                     .localhost_only = variable("ROS_LOCALHOST_ONLY"),
                     .static_peers = variable("ROS_STATIC_PEERS")};
  // "2 eth0 : 2 V3", then a line beginning with a tab for each group.
  std::ifstream file(multicast_groups);
  std::string line;
  std::string interface;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (!line.starts_with('\t')) {
      words >> interface;
    } else if (first == discovery_group && interface != "lo") {
      found.multicast_interfaces.push_back(interface);
    }
  }
  return found;
}

std::vector<Obstacle> obstacles(const Deployment& deployment, const Surroundings& surroundings) {
  std::vector<Obstacle> all;
  const std::string domain = std::to_string(deployment.domain);
  if (!surroundings.domain_id.empty() && surroundings.domain_id != domain) {
    all.push_back(
        {"ROS_DOMAIN_ID is " + surroundings.domain_id + ", the deployment is in domain " + domain,
         "write domain: " + surroundings.domain_id + " in the deployment file"});
  }
  const bool local = surroundings.discovery_range == "LOCALHOST" ||
                     (surroundings.localhost_only == "1" && surroundings.discovery_range.empty());
  if (surroundings.discovery_range == "OFF") {
    all.push_back(
        {"ROS_AUTOMATIC_DISCOVERY_RANGE is OFF: ROS 2 discovers nobody",
         "set it to LOCALHOST for a deployment on the loopback interface, else to SUBNET"});
  } else if (local && !on_loopback(deployment)) {
    all.push_back({"ROS 2 keeps to the loopback interface, the deployment uses " +
                       listed(deployment.network.interfaces),
                   "remove the key network, or set ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET"});
  } else if (!local && on_loopback(deployment) && !surroundings.multicast_interfaces.empty()) {
    all.push_back({"programs of ROS 2 or another DDS discover each other by multicast on " +
                       listed(surroundings.multicast_interfaces) +
                       ", the deployment stays on the loopback interface",
                   "add " + line_that_mends(surroundings.multicast_interfaces) +
                       ", or start ROS 2 with ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST (up to "
                       "Humble ROS_LOCALHOST_ONLY=1)"});
  } else if (!local && !on_loopback(deployment) &&
             deployment.network.discovery != Discovery::multicast) {
    // Were they to discover each other all the same, its messages would be too large.
    all.push_back(
        {"ROS 2 discovers by multicast and sends packets above 1372 bytes, the "
         "deployment does not take them",
         "write " + line_that_mends(deployment.network.interfaces)});
  }
  return all;
}

bool speaks_to_ros2(const Deployment& deployment) {
  return std::ranges::any_of(deployment.services, [](const ServiceConfig& service) {
    return service.kind.starts_with("ros2_");
  });
}

}  // namespace quoin::ros2
