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

#include "deploy/orchestration/backoff.hpp"
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

  /// Starts one more process, on trial: when it dies it is not started again and nothing else
  /// happens. Returns the key by which it is called. Throws std::system_error.
  int add(ProcessPlan plan);
  /// The end of the trial: from now on it is treated like all others, and started again by `plan`.
  void adopt(int key, ProcessPlan plan);
  /// Another way to start the service's process from the next time on.
  void replan(ProcessPlan plan);
  /// The process is about to end, with or without SIGTERM from here; it is not started again, and
  /// killed when it takes long: five seconds for each of `services`.
  void retire(int key, bool terminate, std::size_t services = 1);
  /// SIGKILL.
  void kill(int key);
  [[nodiscard]] bool running(int key) const;
  [[nodiscard]] int process_id(int key) const;
  [[nodiscard]] const ProcessPlan& plan(int key) const { return child(key).plan; }
  /// How a process on trial ended; nothing while it runs.
  [[nodiscard]] std::optional<ProcessEnd> end_of_trial(int key) const;
  /// The process that does the work of a service, or is called like that; nothing when there is
  /// none.
  [[nodiscard]] std::optional<int> key_of(const std::string& name) const;

  /// No process is left and none will be started.
  [[nodiscard]] bool ended() const;
  [[nodiscard]] bool stopping() const { return stopping_; }
  /// 0, or what went wrong: 2 configuration, 3 input of a source, 1 anything else.
  [[nodiscard]] int exit_code() const { return exit_code_; }
  /// Of the process that does the work of the service, or did until the service was removed.
  [[nodiscard]] ProcessFigures figures(const std::string& name) const;
  /// Whether that process is or was one of these.
  [[nodiscard]] bool started(int process_id) const { return started_.contains(process_id); }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Standing {
    regular,
    trial,    ///< started to be adopted or stopped again
    retired,  ///< its service has no more use for it
  };
  struct Child {
    int key = 0;
    Standing standing = Standing::regular;
    ProcessPlan plan;
    ProcessFigures figures;
    std::unique_ptr<Process> process;
    Backoff backoff;
    Clock::time_point started;
    Clock::time_point restart_at;
    Clock::time_point kill_at = Clock::time_point::max();
    std::optional<ProcessEnd> end;  ///< of a process on trial
    bool first = true;
    bool never_adopted = false;
    bool told_to_stop = false;
  };

  Child& insert(ProcessPlan plan);
  [[nodiscard]] Child& child(int key);
  [[nodiscard]] const Child& child(int key) const;
  [[nodiscard]] const Child* find(const std::string& name) const;
  [[nodiscard]] bool was_active(const Child& child) const;
  void forget_the_retired();
  void kill_the_late(Clock::time_point now);
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
  int last_key_ = 0;
  Callbacks callbacks_;
  std::vector<pollfd> descriptors_;
  std::set<int> started_;
  bool stopping_ = false;
  int level_ = -1;  ///< being stopped
  Clock::time_point level_deadline_;
  int exit_code_ = 0;
};

}  // namespace quoin::deploy
