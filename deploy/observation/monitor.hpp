// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <idl/Status.h>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "deploy/observation/end_watch.hpp"
#include "deploy/observation/figures.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/process/heartbeat.hpp"

namespace quoin::deploy {

/// A process as its newest heartbeat describes it.
struct ProcessWatch {
  int process_id = 0;
  std::uint64_t incarnation = 0;
  msg::ServiceState state = msg::ServiceState::STATE_STARTING;
  std::string detail;
};

/// Listens to the heartbeats of a deployment and to what comes out of one host's share of it and
/// is read by no service, in a thread of its own. Services are called by their labels.
class Monitor {
 public:
  /// Throws std::runtime_error when DDS refuses.
  Monitor(const Deployment& deployment, const std::string& host);
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// Listens to the services of `wanted` that are new, too.
  void add(const Deployment& wanted);
  /// These are the services from now on: what is not among them has been removed, what has never
  /// been is forgotten.
  void settle(const Deployment& deployment);
  /// What a process says of itself; nothing before its first heartbeat.
  [[nodiscard]] std::optional<ProcessWatch> process(const std::string& name, int process_id) const;
  /// That process was never part of the deployment.
  void forget(const std::string& name, int process_id);
  [[nodiscard]] bool removed(const std::string& name) const;
  [[nodiscard]] runtime::Participant& participant() { return participant_; }

  /// Whether there is, or was, a service that sends heartbeats.
  [[nodiscard]] bool knows(const std::string& name) const;
  /// Whether the service has ever been active.
  [[nodiscard]] bool was_active(const std::string& name) const;
  /// The share's, as below.
  [[nodiscard]] bool all_were_active() const;
  /// "x (waiting for 2 readers), y" for those of the share that were never active.
  [[nodiscard]] std::string never_active() const;
  /// Processes that report as a service of the share, by service.
  [[nodiscard]] std::map<std::string, std::set<int>> processes() const;
  [[nodiscard]] int newest_process(const std::string& name) const;

  /// Of the share, but for the scans of all sources; everything but durations and restarts, which
  /// the supervisor knows.
  [[nodiscard]] DeploymentFigures figures() const;

  /// After all services have ended: waits up to `timeout` for the last heartbeats of `names`, takes
  /// what has arrived and stops listening; from then on the accounting is final.
  void finish(const std::vector<std::string>& names, std::chrono::milliseconds timeout);

 private:
  struct ServiceWatch {
    std::string name;  // without a strength
    Incarnations incarnations;
    std::map<std::uint64_t, ProcessWatch> processes;  // by incarnation
    std::string kind;
    std::string method;
    bool source = false;
    std::vector<OutputConfig> outputs;
    bool here = true;      // in the share
    bool present = false;  // part of the deployment now
    bool settled = false;  // has ever been
    bool was_active = false;
  };
  void listen();
  bool take_all();
  void take(const msg::ServiceStatus& status);
  void take_note_of(const EndWatch& watch, const msg::Header& header);
  void account_for_the_end();
  void listen_to_ends(const Deployment& deployment, bool joined_late);
  void add(const Deployment& wanted, bool joined_late);
  [[nodiscard]] ServiceWatch* writer_of(const msg::StageTrace& trace);
  [[nodiscard]] static bool ended(const ServiceWatch& watch);
  [[nodiscard]] bool is_present(const std::string& name) const;
  [[nodiscard]] std::vector<SourceInstance> source_instances() const;

  std::string file_;
  std::string host_;
  runtime::Participant participant_;
  runtime::Reader<msg::ServiceStatus> status_reader_;
  runtime::WaitSet wait_set_;
  runtime::MemoryTrim memory_trim_;
  mutable std::mutex mutex_;
  std::map<std::string, ServiceWatch> services_;  // by label
  std::vector<std::string> order_;                // of the services, removed ones last
  std::map<int, std::uint64_t> forgotten_;        // process ids; up to what incarnation
  std::vector<std::unique_ptr<EndWatch>> ends_;
  msg::ServiceStatus status_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace quoin::deploy
