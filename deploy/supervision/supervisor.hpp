// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <poll.h>
#include <set>
#include <string>
#include <vector>

#include "deploy/supervision/backoff.hpp"
#include "deploy/supervision/process.hpp"

namespace quoin::deploy {

/// A process to keep alive.
struct ProcessPlan {
  std::string name;  ///< of the service
  std::filesystem::path program;
  std::vector<std::string> arguments;
  int level = 0;  ///< distance from the source; level 0 is stopped first
  bool source = false;
  bool restart = true;                       ///< start again when it dies
  std::chrono::milliseconds least_pause{0};  ///< before that
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

/// Starts processes, starts those again that die, and stops them level by level so that nothing in
/// flight between them is lost. Single-threaded: everything happens inside `poll`.
///
/// Ends when all sources, if it has any, have ended (what they published is drained by stopping the
/// levels behind them), when stopped, or when a process rejects its configuration before it was
/// first active.
class Supervisor {
 public:
  struct Callbacks {
    /// A line of a process's output.
    std::function<void(const std::string& name, const std::string& line)> output;
    /// Something that the supervisor did or saw.
    std::function<void(const std::string& name, const std::string& text)> event;
    /// Whether the named service has ever reported to be active.
    std::function<bool(const std::string& name)> was_active;
  };

  Supervisor(std::vector<ProcessPlan> plans, Callbacks callbacks);

  /// Starts all processes. Throws std::system_error when that is impossible.
  void start();
  /// Waits until something happens, but no longer than `timeout`, and acts on it. True when
  /// `extra_descriptor` (-1: none) is ready for reading.
  bool poll(std::chrono::milliseconds timeout, int extra_descriptor = -1);
  /// Orderly stop; `poll` carries it out.
  void request_stop();
  /// SIGKILL for all.
  void kill_all();

  /// No process is left and none will be started.
  [[nodiscard]] bool ended() const;
  [[nodiscard]] bool stopping() const { return stopping_; }
  /// 0, or what went wrong: 2 configuration, 3 input of a source, 1 anything else.
  [[nodiscard]] int exit_code() const { return exit_code_; }
  [[nodiscard]] ProcessFigures figures(const std::string& name) const;
  /// Whether that process is or was one of these.
  [[nodiscard]] bool started(int process_id) const { return started_.contains(process_id); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Child {
    ProcessPlan plan;
    ProcessFigures figures;
    std::unique_ptr<Process> process;
    Backoff backoff;
    Clock::time_point started;
    Clock::time_point restart_at;
    bool first = true;
    bool told_to_stop = false;
  };

  void launch(Child& child);
  void collect(Child& child);
  void judge(Child& child, const ProcessEnd& end);
  void die(Child& child, const ProcessEnd& end);
  void advance();
  void stop_next_level(Clock::time_point now);
  void fail(int code);
  [[nodiscard]] std::chrono::milliseconds time_to_next_action(
      std::chrono::milliseconds limit) const;

  std::vector<Child> children_;
  Callbacks callbacks_;
  std::vector<pollfd> descriptors_;
  std::set<int> started_;
  bool stopping_ = false;
  int level_ = -1;  ///< being stopped
  Clock::time_point level_deadline_;
  int exit_code_ = 0;
};

}  // namespace quoin::deploy
