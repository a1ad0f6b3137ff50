// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/orchestration/process.hpp"

namespace quoin::deploy {

/// A process to keep alive.
struct ProcessPlan {
  std::string name;  ///< of the process
  std::filesystem::path program;
  std::vector<std::string> arguments;
  int level = 0;  ///< distance from the source; level 0 is stopped first
  bool source = false;
  bool restart = true;                       ///< start again when it dies
  std::chrono::milliseconds least_pause{0};  ///< before that
  std::vector<std::string> again = {};       ///< more arguments, once it has been active
  std::vector<std::string> services = {};    ///< labels of those that run in it

  /// Whether that service runs in it, or it is called like that.
  [[nodiscard]] bool runs(const std::string& service) const;
};

enum class ProcessPhase {
  running,
  pausing,   ///< died, will be started again
  finished,  ///< ended in order
  dead,      ///< died and stays dead
};

/// What is known of a supervised process.
struct ProcessFigures {
  ProcessPhase phase = ProcessPhase::running;
  int process_id = 0;  ///< of the last process
  std::uint64_t restarts = 0;
};

/// The processes of a running deployment, as those see them who change or report it: those of the
/// Supervisor, or of a test.
class SupervisedProcesses {
 public:
  SupervisedProcesses() = default;
  virtual ~SupervisedProcesses() = default;
  SupervisedProcesses(const SupervisedProcesses&) = delete;
  SupervisedProcesses& operator=(const SupervisedProcesses&) = delete;

  /// Starts one more process, on trial: when it dies it is not started again and nothing else
  /// happens. Returns the key by which it is called. Throws std::system_error.
  virtual int add(ProcessPlan plan) = 0;
  /// The end of the trial: from now on it is treated like all others, and started again by `plan`.
  virtual void adopt(int key, ProcessPlan plan) = 0;
  /// Another way to start the service's process from the next time on.
  virtual void replan(ProcessPlan plan) = 0;
  /// The process is about to end, with or without SIGTERM from here; it is not started again, and
  /// killed when it takes long: five seconds for each of `services`. Nothing when it is gone and
  /// forgotten, as it may be as soon as it has died and others do the work of all its services.
  virtual void retire(int key, bool terminate, std::size_t services = 1) = 0;
  /// SIGKILL. Nothing when the process is gone.
  virtual void kill(int key) = 0;

  /// False, too, when the process is gone and forgotten.
  [[nodiscard]] virtual bool running(int key) const = 0;
  /// These two throw std::out_of_range when it is forgotten: only of processes that run, and of
  /// those on trial.
  [[nodiscard]] virtual int process_id(int key) const = 0;
  [[nodiscard]] virtual const ProcessPlan& plan(int key) const = 0;
  /// How a process on trial ended; nothing while it runs.
  [[nodiscard]] virtual std::optional<ProcessEnd> end_of_trial(int key) const = 0;
  /// The process that does the work of a service, or is called like that; nothing when there is
  /// none.
  [[nodiscard]] virtual std::optional<int> key_of(const std::string& name) const = 0;
  /// Of that process, or of the one that did the work until the service was removed.
  [[nodiscard]] virtual ProcessFigures figures(const std::string& name) const = 0;

  /// No process is left and none will be started.
  [[nodiscard]] virtual bool ended() const = 0;
  [[nodiscard]] virtual bool stopping() const = 0;
};

}  // namespace quoin::deploy
