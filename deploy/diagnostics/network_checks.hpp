// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics/line_scatter.hpp"
#include "deploy/diagnostics/check.hpp"
#include "services/deployment/deployment.hpp"
#include "services/ros2/reach.hpp"

namespace quoin::deploy {

/// A process that was heard as a service.
struct HeardProcess {
  std::string service;  ///< namespace and label
  std::string host;
  std::uint32_t process = 0;
  std::uint64_t incarnation = 0;
  bool active = true;  ///< at work; not waiting to begin, or to take over
  /// Heartbeats that were sent while this one listened; a late reader gets an older one, too.
  std::size_t heard = 0;
  /// [ns] from the stamp of such a heartbeat, by the sender's clock, to its reception by this
  /// host's: the smallest.
  std::int64_t delay = 0;
  std::vector<std::string> incompatible_qos;
  std::vector<std::string> input_complaints = {};          ///< repeated and refused messages
  std::optional<LineScatter> line_scatter = std::nullopt;  ///< of one that fits lines
};

/// Whether the clocks of other hosts agree with that of `own_host`: latencies and accounting over
/// hosts compare stamps.
[[nodiscard]] Checks check_clocks(const std::vector<HeardProcess>& processes,
                                  const std::string& own_host);

/// Whether two processes are at work under one label, which is what two deployments of one domain
/// and namespace do.
[[nodiscard]] Checks check_doubles(const std::vector<HeardProcess>& processes);

/// Whether somebody sends what no service of the deployments does. `foreign_writers`: topics that
/// others write, too.
[[nodiscard]] Checks check_strangers(const std::vector<HeardProcess>& processes,
                                     const std::vector<std::string>& foreign_writers);

/// What readers and writers of the services do not agree on: what those report, and what keeps
/// their heartbeats from being read.
[[nodiscard]] Checks check_qos(const std::vector<HeardProcess>& processes,
                               const std::vector<std::string>& of_heartbeats);

/// Whether the lines of the last minute scatter as the sensor model says, which their covariances
/// rest on.
[[nodiscard]] Checks check_line_scatter(const std::vector<HeardProcess>& processes);

/// Whether the services of `deployment` that speak to ROS 2 and programs of ROS 2 on this host
/// discover each other; nothing where no service does.
[[nodiscard]] Checks check_ros2(const Deployment& deployment,
                                const ros2::Surroundings& surroundings);

}  // namespace quoin::deploy
