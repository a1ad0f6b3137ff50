// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "sensor_bridge/rplidar/driver/driver.hpp"
#include "tests/sensor_bridge/rplidar/driver/stop_switch.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Short enough for tests of what goes wrong.
[[nodiscard]] inline TimeOuts short_time_outs() {
  using namespace std::chrono_literals;
  return {.connection = 500ms,
          .probing = 100ms,
          .answer = 200ms,
          .quiet = 20ms,
          .draining = 150ms,
          .reset = 150ms,
          .spin_up = 1500ms,
          .silence = 200ms,
          .window = 200ms,
          .revolution = 700ms,
          .stable = 400ms,
          .between_resets = 60000ms,
          .shortest_pause = 10ms,
          .longest_pause = 50ms,
          .busy_pause = 50ms};
}

/// What a driver has told.
struct DriverRecord {
  std::vector<DriverState> states;
  std::vector<Diagnosis> problems;
  std::optional<DeviceFacts> facts;
  std::optional<ScanPlan> plan;
  std::optional<ScanMode> mode;  ///< of the last revolution
  Revolution last_revolution;
  DriverCounts counts;

  [[nodiscard]] bool has_problem(Finding finding) const {
    for (const Diagnosis& problem : problems) {
      if (problem.finding == finding) return true;
    }
    return false;
  }
};

/// A driver in a thread of its own.
class DriverRun : private DriverListener {
 public:
  explicit DriverRun(const DriverSettings& settings, Opener open = {})
      : driver_(settings, *this, std::move(open)), thread_([this] { run(); }) {}
  ~DriverRun() override { stop(); }

  /// Waits until the condition holds of what was told so far: false when it does not for long, or
  /// the driver has ended.
  [[nodiscard]] bool wait_for(const std::function<bool(const DriverRecord&)>& condition) {
    std::unique_lock lock(mutex_);
    (void)changed_.wait_for(lock, std::chrono::seconds(20),
                            [&] { return error_ || condition(record_); });
    return condition(record_);
  }

  /// Waits for that many revolutions more.
  [[nodiscard]] bool wait_for_revolutions(std::uint64_t count) {
    std::unique_lock lock(mutex_);
    const std::uint64_t enough = record_.counts.revolutions + count;
    lock.unlock();
    return wait_for([=](const DriverRecord& r) { return r.counts.revolutions >= enough; });
  }

  [[nodiscard]] bool wait_for_problem(Finding finding) {
    return wait_for([=](const DriverRecord& r) { return r.has_problem(finding); });
  }

  /// Forgets problems that were told.
  void clear_problems() {
    const std::lock_guard lock(mutex_);
    record_.problems.clear();
  }

  /// Whether anybody wants the revolutions.
  void set_wanted(bool wanted) { wanted_ = wanted; }

  /// Returns when the driver has ended.
  void stop() {
    switch_.stop();
    if (thread_.joinable()) thread_.join();
  }

  [[nodiscard]] DriverRecord record() {
    const std::lock_guard lock(mutex_);
    return record_;
  }

  /// What the driver ended with by itself, if it did.
  [[nodiscard]] std::exception_ptr error() {
    const std::lock_guard lock(mutex_);
    return error_;
  }

 private:
  void run() {
    try {
      driver_.run(switch_.interruption());
    } catch (...) {
      tell([this] { error_ = std::current_exception(); });
    }
  }

  void tell(const std::function<void()>& change) {
    const std::lock_guard lock(mutex_);
    change();
    record_.counts = driver_.counts();
    changed_.notify_all();
  }

  bool is_wanted() override { return wanted_; }
  void state_changed(DriverState state) override {
    tell([&] { record_.states.push_back(state); });
  }
  void connected(const DeviceFacts& facts, const ScanPlan& plan) override {
    tell([&] {
      record_.facts = facts;
      record_.plan = plan;
    });
  }
  void revolution(const Revolution& revolution, const ScanMode& mode) override {
    tell([&] {
      record_.last_revolution = revolution;
      record_.mode = mode;
    });
  }
  void problem(const Diagnosis& diagnosis) override {
    tell([&] { record_.problems.push_back(diagnosis); });
  }

  std::atomic<bool> wanted_ = true;
  std::mutex mutex_;
  std::condition_variable changed_;
  DriverRecord record_;
  std::exception_ptr error_;
  StopSwitch switch_;
  Driver driver_;
  std::thread thread_;
};

}  // namespace quoin::sensor_bridge::rplidar
