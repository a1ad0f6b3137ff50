// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <idl/Status.h>
#include <mutex>
#include <string>
#include <thread>

#include "core/statistics/quantile_histogram.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/process/memory.hpp"
#include "services/runtime/process/supervisor_link.hpp"
#include "services/runtime/dds/writer.hpp"

namespace quoin::runtime {

/// Where a scan was lost inside the reach of one service.
enum class LossCause {
  link,        ///< on the way from the service before
  processing,  ///< the method threw
  publishing,  ///< DDS did not take the result
};

/// "starting", "active", ...
[[nodiscard]] std::string state_name(msg::ServiceState state);

/// Counts what a service does and tells it to everybody, once a second and at each change of state,
/// from a thread of its own so that the data path never waits for it. Tells the service manager
/// that started the process, too: ready when active.
class Heartbeat {
 public:
  Heartbeat(Participant& participant, const Deployment& deployment,
            const ServiceConfig& config);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// Start of this process [ns since the Unix epoch].
  [[nodiscard]] std::uint64_t incarnation() const { return incarnation_; }

  void set_state(msg::ServiceState state, const std::string& detail = "");
  void set_detail(const std::string& detail);
  void set_method(const std::string& method);
  /// Of a source that does not begin with scan 0.
  void set_first_sequence_number(std::uint64_t number);
  /// Adds the entry of this name, or replaces its value.
  void set_diagnostic(const std::string& name, const std::string& value);
  /// Asked at each heartbeat for what the endpoints know: fills the matched_ and incompatible_
  /// fields.
  /// An empty function takes the report back: when this returns, it no longer runs.
  void set_endpoint_report(std::function<void(msg::ServiceStatus&)> report);

  void count_received(std::uint64_t upstream_lost, std::uint64_t link_lost);
  void count_loss(LossCause cause);
  void count_control_drop();
  /// A result was published: stage times [ns since the Unix epoch] and parts without a result.
  void count_published(std::int64_t scan_published, std::int64_t received, std::int64_t published,
                       std::size_t failures);

  /// Sign of life of the thread that data passes through.
  [[nodiscard]] Pulse& pulse() { return supervisor_.pulse(); }
  /// The end has begun: what is in flight is worked off.
  void stopping() { supervisor_.stopping(); }
  /// The last heartbeat, acknowledged by those who listen or given up after half a second.
  void finish(msg::ServiceState state, const std::string& detail = "");

 private:
  void run();
  [[nodiscard]] msg::ServiceStatus snapshot();
  void tell_supervisor(const msg::ServiceStatus& status);

  const std::uint64_t incarnation_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool changed_state_ = false;
  bool ending_ = false;
  msg::ServiceStatus status_;
  std::uint64_t losses_[3] = {0, 0, 0};
  QuantileHistogram latency_;
  QuantileHistogram processing_;
  std::uint64_t rate_published_ = 0;
  std::int64_t rate_since_ = 0;
  std::function<void(msg::ServiceStatus&)> endpoint_report_;
  std::mutex write_mutex_;  // heartbeats leave in the order of their snapshots
  Writer<msg::ServiceStatus> writer_;
  SupervisorLink supervisor_;
  MemoryTrim memory_trim_;
  std::string told_;          // state and detail that the supervisor knows
  std::int64_t told_at_ = 0;  // [ns since the Unix epoch]
  std::thread thread_;
};

}  // namespace quoin::runtime
