// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <idl/Status.h>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deploy/observation/end_watch.hpp"
#include "deploy/observation/figures.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// A process as its newest heartbeat describes it.
struct ProcessWatch {
  int process_id = 0;
  std::uint64_t incarnation = 0;
  msg::ServiceState state = msg::ServiceState::STATE_STARTING;
  std::string detail;
};

/// What is known of a deployment from the heartbeats of its services, and from what comes out of
/// one host's share of it and is read by no service. Services are called by their labels. Safe to
/// use from several threads.
class DeploymentRecord {
 public:
  /// An output that no service reads: what arrives there is to be given to `receive`. May throw.
  using OnEnd = std::function<void(std::size_t end, const Connection& connection)>;

  DeploymentRecord(const Deployment& deployment, std::string host, OnEnd on_end);

  /// Expects the services of `wanted` that are new, too; what they did before is for nobody. Throws
  /// what `on_end` throws.
  void add(const Deployment& wanted);
  /// These are the services from now on: what is not among them has been removed; what was added
  /// and never confirmed is forgotten.
  void confirm(const Deployment& deployment);

  /// A heartbeat.
  void receive(const msg::ServiceStatus& status);
  /// A message at an end.
  void receive(std::size_t end, const msg::Header& header, const EndMessage& message = {});
  /// All processes have ended and nothing more will arrive: the accounting is final.
  void close();

  /// What a process reports of itself; nothing before its first heartbeat.
  [[nodiscard]] std::optional<ProcessWatch> process(const std::string& name, int process_id) const;
  /// That process was never part of the deployment.
  void forget(const std::string& name, int process_id);
  [[nodiscard]] bool removed(const std::string& name) const;
  /// Whether there is, or was, a service that sends heartbeats.
  [[nodiscard]] bool knows(const std::string& name) const;
  /// Whether the service has ever been active.
  [[nodiscard]] bool was_active(const std::string& name) const;
  /// Whether the newest process of each has reported its end.
  [[nodiscard]] bool have_ended(const std::vector<std::string>& names) const;

  /// Of the share, as below.
  [[nodiscard]] bool all_were_active() const { return never_active().empty(); }
  /// "x (waiting for 2 readers), y" for those of the share that were never active.
  [[nodiscard]] std::string never_active() const;
  /// Processes that report as a service of the share, by service.
  [[nodiscard]] std::map<std::string, std::set<int>> processes() const;

  /// Of the share, but for the scans of all sources; everything but durations and restarts, which
  /// the supervisor knows.
  [[nodiscard]] DeploymentFigures figures() const;

 private:
  struct ServiceWatch {
    std::string name;  // without a strength
    Incarnations incarnations;
    std::map<std::uint64_t, ProcessWatch> processes;  // by incarnation
    std::string kind;
    std::string method;
    std::uint64_t method_of = 0;  // incarnation that reported it
    bool source = false;
    std::vector<OutputConfig> outputs;
    bool local = true;       // in the share
    bool present = false;    // part of the deployment now
    bool confirmed = false;  // has ever been
    bool was_active = false;
  };
  void add(const Deployment& wanted, bool joined_late);
  [[nodiscard]] std::vector<Connection> new_ends(const std::vector<Connection>& ends) const;
  void note_published(const EndWatch& watch, const msg::Header& header);
  [[nodiscard]] ServiceWatch* writer_of(const msg::StageTrace& trace);
  [[nodiscard]] static bool ended(const ServiceWatch& watch);
  [[nodiscard]] bool is_present(const std::string& name) const;
  [[nodiscard]] std::vector<SourceInstance> source_instances() const;

  const std::string host_;
  const OnEnd on_end_;
  mutable std::mutex mutex_;
  std::string file_;
  std::map<std::string, ServiceWatch> services_;  // by label
  std::vector<std::string> order_;                // of the services, removed ones last
  std::map<int, std::uint64_t> forgotten_;        // process ids; up to what incarnation
  std::vector<EndWatch> ends_;
};

}  // namespace quoin::deploy
