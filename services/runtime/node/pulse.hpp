// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>

namespace quoin::runtime {

/// Sign of life of the one thread that data passes through. It says when it will be heard of again;
/// another thread asks whether it was. Costs a look at the clock and a store.
class Pulse {
 public:
  using Clock = std::chrono::steady_clock;

  /// Something was done, and the next thing begins.
  void beat() { due(Clock::now()); }
  /// There is nothing to do before `time`.
  void wait_until(Clock::time_point time) { due(std::max(time, Clock::now())); }
  /// Whether the thread is overdue by no more than `allowance`. Before its first beat it is not.
  [[nodiscard]] bool alive(Clock::time_point now, Clock::duration allowance) const {
    return (now - allowance).time_since_epoch().count() <= due_.load(std::memory_order_relaxed);
  }

 private:
  void due(Clock::time_point time) {
    due_.store(time.time_since_epoch().count(), std::memory_order_relaxed);
  }

  std::atomic<Clock::rep> due_{Clock::time_point::max().time_since_epoch().count()};
};

}  // namespace quoin::runtime
