// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace quoin::runtime {

/// A request to end: a flag, a wake-up and a callback.
class Stop {
 public:
  [[nodiscard]] bool requested() const { return requested_.load(std::memory_order_acquire); }
  void request();
  /// Called once, from another thread, when the stop is requested; at once if it has been. An empty
  /// function takes the callback back: when this returns, it no longer runs. Must not call back
  /// here.
  void on_request(std::function<void()> callback);
  /// Waits until `time`; false at once when the stop is requested.
  [[nodiscard]] bool wait_until(std::chrono::steady_clock::time_point time);

 private:
  std::atomic<bool> requested_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> callback_;
};

/// Requested by SIGTERM and SIGINT. Make one, in main, before any other thread exists: it blocks
/// the signals for all threads started later.
class StopSignal : public Stop {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

 private:
  void watch();

  int signal_descriptor_ = -1;
  int end_descriptor_ = -1;
  std::thread watcher_;
};

}  // namespace quoin::runtime
