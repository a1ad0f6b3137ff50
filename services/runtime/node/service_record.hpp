// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <idl/Status.h>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/statistics/order_statistics.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::runtime {

/// Where a scan was lost inside the reach of one service.
enum class LossCause {
  link,        ///< on the way from the service before
  processing,  ///< the method threw
  publishing,  ///< DDS did not take the result
};

/// "starting", "active", ...
[[nodiscard]] std::string state_name(msg::ServiceState state);

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

/// What one service counts and says of itself. Any thread may write, another publishes it
/// (Heartbeat). Knows no DDS.
class ServiceRecord {
 public:
  explicit ServiceRecord(const ServiceConfig& config);
  ServiceRecord(const ServiceRecord&) = delete;
  ServiceRecord& operator=(const ServiceRecord&) = delete;

  /// Start of this process [ns since the Unix epoch].
  [[nodiscard]] std::uint64_t incarnation() const { return incarnation_; }

  void set_state(msg::ServiceState state, const std::string& detail = "");
  void set_detail(const std::string& detail);
  [[nodiscard]] std::string detail() const;
  void set_method(const std::string& method);
  /// Of a source that does not begin with scan 0.
  void set_first_sequence_number(std::uint64_t number);
  /// Adds the entry of this name, or replaces its value.
  void set_diagnostic(const std::string& name, const std::string& value);
  /// Asked at each snapshot for what the endpoints know: fills writers, readers and the
  /// incompatible_ field. An empty function takes the report back: when this returns, it no longer
  /// runs.
  void set_endpoint_report(std::function<void(msg::ServiceStatus&)> report);

  /// Adds a port; its number is how many there were before.
  void add_input(const std::string& port, const std::string& topic);
  void add_output(const std::string& topic);

  /// A message came by that input port, which has lost so many so far. What an `each` port received
  /// and missed counts for the service.
  void count_received(std::size_t input, bool each, std::uint64_t upstream_lost,
                      std::uint64_t link_lost);
  /// A message of that port is not used, for that reason: one of a few.
  void count_refused(std::size_t input, const std::string& reason);
  void count_duplicate(std::size_t input);
  /// A result was made without a message of that port.
  void count_unjoined(std::size_t input);
  void count_loss(LossCause cause);
  void count_control_drop();
  /// A message went out on that topic, or did not.
  void count_output(std::size_t output, bool published);
  /// A message was handled: stage times [ns since the Unix epoch], `published` being 0 when nothing
  /// was to go out, and parts without a result.
  void count_result(std::int64_t scan_published, std::int64_t received, std::int64_t published,
                    std::size_t failures);

  /// Called at each change of state, from the thread that makes it; must not call back here. An
  /// empty function takes the callback back: when this returns, it no longer runs.
  void on_change(std::function<void()> callback);

  /// All of it as it is now, but for the memory of the process. When for seconds nothing that came
  /// could be used, the service is reported as failed until something can.
  [[nodiscard]] msg::ServiceStatus snapshot();

 private:
  const std::uint64_t incarnation_;
  mutable std::mutex mutex_;
  std::function<void()> on_change_;
  msg::ServiceStatus status_;
  std::uint64_t losses_[3] = {0, 0, 0};
  QuantileHistogram latency_;
  QuantileHistogram processing_;
  std::uint64_t rate_published_ = 0;
  std::int64_t rate_since_ = 0;
  std::function<void(msg::ServiceStatus&)> endpoint_report_;
  std::vector<std::map<std::string, std::uint64_t>> refused_;  // by input and reason

  std::map<std::string, std::uint64_t> logged_refused_;  // by port and reason
  void log_refused();

  // Whether what comes can be used.
  void look_whether_blocked(std::int64_t now);
  std::uint64_t used_ = 0;
  std::uint64_t unused_ = 0;
  std::int64_t unused_since_ = 0;  // [ns since the Unix epoch] nothing was; 0 when something was
  std::int64_t unused_last_ = 0;   // likewise, when the last came that was not
};

/// Adds to the counts of a port.
void add_refused(msg::InputStatus& input, const std::string& reason, std::uint64_t count);

}  // namespace quoin::runtime
