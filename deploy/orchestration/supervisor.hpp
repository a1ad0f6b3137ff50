// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
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
#include "deploy/orchestration/supervised_processes.hpp"

namespace quoin::deploy {

/// Starts processes, starts those again that die, and stops them level by level so that nothing in
/// flight between them is lost. Single-threaded: everything happens inside `poll`.
///
/// Ends when all sources, if it has any, have ended (what they published is drained by stopping the
/// levels behind them), when stopped, or when a process rejects its configuration before it was
/// first active.
class Supervisor : public SupervisedProcesses {
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

  int add(ProcessPlan plan) override;
  void adopt(int key, ProcessPlan plan) override;
  void replan(ProcessPlan plan) override;
  void retire(int key, bool terminate, std::size_t services = 1) override;
  void kill(int key) override;
  [[nodiscard]] bool running(int key) const override;
  [[nodiscard]] int process_id(int key) const override;
  [[nodiscard]] const ProcessPlan& plan(int key) const override { return child(key).plan; }
  [[nodiscard]] std::optional<ProcessEnd> end_of_trial(int key) const override;
  [[nodiscard]] std::optional<int> key_of(const std::string& name) const override;
  [[nodiscard]] ProcessFigures figures(const std::string& name) const override;
  [[nodiscard]] bool ended() const override;
  [[nodiscard]] bool stopping() const override { return stopping_; }

  /// 0, or what went wrong: 2 configuration, 3 input of a source, 1 anything else.
  [[nodiscard]] int exit_code() const { return exit_code_; }
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
    bool asked_to_stop = false;
  };

  Child& insert(ProcessPlan plan);
  [[nodiscard]] Child* known(int key);
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
