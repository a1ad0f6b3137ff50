// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <idl/Control.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deploy/observation/deployment_record.hpp"
#include "deploy/orchestration/dialogue.hpp"
#include "deploy/orchestration/plan.hpp"
#include "deploy/orchestration/supervised_processes.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// Carries out a plan on the running processes, or leaves everything as it was.
///
/// First all new processes are started, held, and everything that could fail is tried. Only when
/// each of them is matched with its neighbours and all methods are exchanged do they begin to
/// publish, the replaced ones hand over and what is not wanted any more stops. From there on the
/// only way is forward: a process that fails is killed, and what takes its place is at work.
/// Between the two one may wait for other hosts, and then do one change after the other.
class Changeover {
 public:
  struct World {
    SupervisedProcesses& processes;
    DeploymentRecord& record;
    Dialogue& dialogue;
    /// Whether not to wait any longer for what is new to be ready.
    std::function<bool()> withdrawn;
    /// The last line that a service has written; "" when there is none.
    std::function<std::string(const std::string& service)> last_line;
  };

  /// `running`: what the processes do now. `elsewhere`: what other hosts change meanwhile. `plans`:
  /// how to start the services of `wanted`, held processes apart. All must outlive the object.
  Changeover(World world, const Deployment& running, const Deployment& wanted, const Plan& plan,
             const Plan& elsewhere, const std::vector<ProcessPlan>& plans,
             std::chrono::milliseconds timeout);

  /// Up to where it can be rolled back. Throws std::runtime_error with the reason when it was.
  void prepare();
  /// Instead of what follows: leaves everything as it was.
  void roll_back();
  /// Carries out the change of one service. Nothing when there is none, or it has been done.
  void change(const std::string& service);
  /// All changes that are left, in an order in which no scan is lost.
  void finish();

  /// The first scan that each changed service handled as wanted, where there is one.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& first_scans() const {
    return first_scans_;
  }

 private:
  struct Trial {
    const Change* change;
    const ServiceConfig* config;
    const ProcessPlan* plan;
    int key;
    std::uint64_t incarnation = 0;
    std::optional<msg::ControlReply> held = std::nullopt;  ///< since when it keeps what comes
  };

  void start_trials();
  [[nodiscard]] int start(const ProcessPlan& plan);
  [[nodiscard]] int readers_to_go(const ServiceConfig& service) const;
  void wait_until_ready();
  [[nodiscard]] bool ready(Trial& trial);
  [[nodiscard]] std::uint64_t incarnation_of(const std::string& service, int key) const;
  [[nodiscard]] std::string why_not_ready(const Trial& trial) const;
  void swap_methods();
  void commit();
  void hold_all();
  void begin(const Trial& trial);
  void take_over(const Trial& trial);
  [[nodiscard]] msg::ControlReply hold(const Trial& trial, std::chrono::milliseconds timeout);
  void begin_with(const Trial& trial, msg::ControlRequest take);
  void stop_removed();
  void stop_service(const std::string& service);
  void stop(const std::vector<int>& keys);

  World world_;
  const Deployment& running_;
  const Deployment& wanted_;
  const Plan& plan_;
  const Plan& elsewhere_;
  const std::vector<ProcessPlan>& plans_;
  std::chrono::milliseconds timeout_;
  std::vector<Trial> trials_;
  // Of a process that is left, as it was at the beginning: it may die and be forgotten meanwhile.
  struct Predecessor {
    int key;
    int level;
    std::vector<std::string> services;
  };
  std::map<std::string, Predecessor> predecessors_;  // by service
  std::vector<ProcessPlan> stopped_beforehand_;      // to start again when it fails
  std::vector<std::string> swapped_;
  bool committed_ = false;
  std::set<std::string> done_;  // changes
  std::map<std::string, std::uint64_t> first_scans_;
};

}  // namespace quoin::deploy
