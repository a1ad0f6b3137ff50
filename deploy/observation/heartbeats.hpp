// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <idl/Status.h>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/statistics/line_scatter.hpp"
#include "deploy/observation/figures.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::deploy {

/// What a heartbeat says, in the terms of a report.
[[nodiscard]] ServiceReport report_of(const msg::ServiceStatus& status);

/// How much lines scatter, of a service that fits them.
[[nodiscard]] std::optional<LineScatter> line_scatter_of(const msg::ServiceStatus& status);

/// What is wrong with what comes in by the ports of a service, a text each: messages that are
/// repeated or refused.
[[nodiscard]] std::vector<std::string> input_complaints(const msg::ServiceStatus& status);

/// Which services are of which version of Quoin and of its DDS, a line for each:
/// "Quoin 0.1.0 with Fast DDS 3.1.2: front, walls". `services` are names with heartbeats.
[[nodiscard]] std::vector<std::string> version_lines(
    const std::vector<std::pair<std::string, const msg::ServiceStatus*>>& services);

/// Topics with more writers than services that report to write them, of all that report.
[[nodiscard]] std::vector<std::string> foreign_writers(
    const std::vector<const msg::ServiceStatus*>& statuses);

/// What one process reported of itself.
struct HeardHeartbeats {
  msg::ServiceStatus newest;
  std::chrono::steady_clock::time_point last;  ///< when that was heard
  /// Of those that were sent while we listened; the first may be older.
  std::size_t fresh = 0;
  std::int64_t delay = 0;  ///< [ns] from stamp to reception, the smallest of the fresh ones
};

/// Listens to the heartbeats of all services of a namespace, or of all namespaces, wherever they
/// run.
class HeartbeatListener {
 public:
  /// Throws std::runtime_error when DDS refuses.
  HeartbeatListener(const Deployment& deployment, const std::string& name, bool all_namespaces);

  /// Listens for `seconds`, but not once `complete` holds.
  void listen(double seconds, const std::function<bool()>& complete);

  /// By namespace and incarnation.
  using Heard = std::map<std::pair<std::string, std::uint64_t>, HeardHeartbeats>;
  [[nodiscard]] const Heard& heard() const { return heard_; }
  /// Processes whose heartbeats are not read, because theirs have other fields or another QoS: a
  /// line each, with both sides' values.
  [[nodiscard]] std::vector<std::string> unreadable() const;
  /// The newest process of each service, by namespace and label.
  [[nodiscard]] std::map<std::pair<std::string, std::string>, HeardHeartbeats> newest() const;

 private:
  using StatusReader = runtime::Reader<msg::ServiceStatus>;
  void look_for_namespaces();
  void add(const std::string& name_space);
  void take(const std::string& name_space, StatusReader& reader);
  [[nodiscard]] bool has_place(const std::string& name_space, std::uint64_t writer) const;

  bool all_namespaces_;
  runtime::Participant participant_;
  runtime::WaitSet wait_set_;
  std::map<std::string, std::unique_ptr<StatusReader>> readers_;
  msg::ServiceStatus status_;
  Heard heard_;
  std::set<std::pair<std::string, std::string>> known_;  // namespaces and labels of the deployment
  std::map<std::uint64_t, std::size_t> processes_of_;    // in heard_, by writer
};

}  // namespace quoin::deploy
