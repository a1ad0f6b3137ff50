// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace quoin::runtime {

/// Reports the state of this process to the service manager that started it, in systemd's notify
/// protocol (sd_notify(3)). Does nothing where there is none (NOTIFY_SOCKET is not set).
class SupervisorLink {
 public:
  using Clock = std::chrono::steady_clock;
  /// Whether the process is overdue with its signs of life by no more than `allowance`.
  using Alive = std::function<bool(Clock::time_point now, Clock::duration allowance)>;

  explicit SupervisorLink(Alive alive);
  ~SupervisorLink();
  SupervisorLink(const SupervisorLink&) = delete;
  SupervisorLink& operator=(const SupervisorLink&) = delete;

  /// From now on the service does what it is there for. Where the manager wants signs of life
  /// (WATCHDOG_USEC), it gets them from a thread at twice that rate, as long as the process is not
  /// overdue by half that period.
  void ready();
  /// One line for who asks how the service is.
  void status(const std::string& text) const;
  void stopping();
  /// No more signs of life.
  void stop();

 private:
  void watch(std::chrono::microseconds period);

  const Alive alive_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ready_ = false;
  bool stopping_ = false;
  bool ending_ = false;
  std::thread watchdog_;
};

}  // namespace quoin::runtime
