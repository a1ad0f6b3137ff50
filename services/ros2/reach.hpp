// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin::ros2 {

/// What decides whether programs of ROS 2 on this host and a deployment discover each other.
struct Surroundings {
  /// Interfaces but the loopback one where some program listens to DDS discovery by multicast.
  std::vector<std::string> multicast_interfaces = {};
  // Environment variables of ROS 2, as programs that are started like this one have them; "" where
  // they are not set.
  std::string domain_id = {};
  std::string discovery_range = {};  ///< from Iron on
  std::string localhost_only = {};   ///< up to Humble
  std::string static_peers = {};     ///< from Iron on
};

/// `multicast_groups` is /proc/net/igmp. Sends nothing.
[[nodiscard]] Surroundings look_around(
    const std::filesystem::path& multicast_groups = "/proc/net/igmp");

/// A reason why they may not discover each other, and which line mends it.
struct Obstacle {
  std::string text;
  std::string advice;
};
[[nodiscard]] std::vector<Obstacle> obstacles(const Deployment& deployment,
                                              const Surroundings& surroundings);

/// Whether a service of the deployment reads or writes topics of ROS 2.
[[nodiscard]] bool speaks_to_ros2(const Deployment& deployment);

}  // namespace quoin::ros2
