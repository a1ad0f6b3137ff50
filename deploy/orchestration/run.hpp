// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <idl/Control.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deploy/observation/figures.hpp"
#include "deploy/observation/monitor.hpp"
#include "deploy/orchestration/apply_requests.hpp"
#include "deploy/orchestration/composition.hpp"
#include "deploy/orchestration/dialogue.hpp"
#include "deploy/orchestration/exclusive.hpp"
#include "deploy/orchestration/file_watch.hpp"
#include "deploy/orchestration/requester.hpp"
#include "deploy/orchestration/run_progress.hpp"
#include "deploy/orchestration/signals.hpp"
#include "deploy/orchestration/supervisor.hpp"

namespace quoin::deploy {

struct RunOptions {
  std::string file;
  std::string host;       ///< as host_to_run takes it
  double duration = 0.0;  ///< [s] from when all services are active; 0: no end
  bool watch = false;     ///< apply the file whenever it changes
};

struct RunOutcome {
  int exit_code = 0;
  DeploymentFigures figures;
};

/// One run of one host's share of a deployment, from the first process to the last figures:
/// supervises its processes, applies other files to them on request, and stops on SIGINT or
/// SIGTERM.
class Run {
 public:
  struct Callbacks {
    /// A line of a service's log, or one of our own under the name "quoin".
    std::function<void(const std::string& name, const std::string& line)> log;
    /// The figures so far, several times a second.
    std::function<void(const DeploymentFigures& figures)> progress;
  };

  /// Make it before any thread is started, for the signals. Throws DeploymentError, or
  /// std::runtime_error when the deployment is up already, a program is missing or DDS refuses.
  Run(const RunOptions& options, Callbacks callbacks);

  /// Returns when all processes have ended.
  [[nodiscard]] RunOutcome run();

 private:
  void say(const std::string& text) { callbacks_.log("quoin", text); }
  bool look(std::chrono::milliseconds timeout);
  void handle_signals(int count);
  void observe();
  void warn_of_strangers();
  ApplyOutcome apply(ApplyRequest request, const std::function<void(const Plan&)>& on_plan);
  void answer(const msg::ControlRequest& request);
  Instruction next_instruction(Dialogue& dialogue, bool begun, std::chrono::milliseconds timeout,
                               std::optional<msg::ControlRequest>& last);
  [[nodiscard]] DeploymentFigures figures() const;
  [[nodiscard]] std::vector<std::string> orderly_ended() const;

  RunOptions options_;
  Callbacks callbacks_;
  FileWatch watch_;  // before the file is read
  Composition composition_;
  Exclusive exclusive_;
  Signals signals_;  // before the threads of the monitor
  Monitor monitor_;
  DdsRequester requester_;
  ApplyRequests apply_requests_;
  Supervisor supervisor_;  // last of those: what it calls outlives it
  ActiveTime active_time_;
  std::set<int> strangers_;
  const msg::ControlRequest* conducted_ = nullptr;  // what is applied with other hosts, if anything
  std::map<std::string, std::string> last_lines_;   // of the services, since the last apply
  bool stop_asked_ = false;
  int exit_code_ = 0;
};

}  // namespace quoin::deploy
