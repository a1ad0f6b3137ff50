// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <idl/Status.h>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/node/service_record.hpp"
#include "services/runtime/process/supervisor_link.hpp"

namespace quoin::runtime {

/// Physical memory of this process [byte].
[[nodiscard]] std::uint64_t resident_memory();

/// Gives back to the system what a burst has needed and is free again: the C library keeps what is
/// not at the end of a heap, and each burst may leave it in other places.
class MemoryTrim {
 public:
  using Clock = std::chrono::steady_clock;

  /// Large blocks and the ends of heaps are given back as soon as they are free from now on.
  explicit MemoryTrim(Clock::duration period = std::chrono::seconds(10));

  /// To be called now and then. Looks once in a period; when the process has grown since it was
  /// last trimmed, it is trimmed again, which takes a fraction of a millisecond.
  void tick();

 private:
  Clock::duration period_;
  Clock::time_point next_;
  std::uint64_t trimmed_to_ = 0;  // [byte]
};

/// Publishes the records of a process' services once a second and at each change of state, from a
/// thread of its own so that the data path never waits for it. A service whose thread has not been
/// heard of for too long is reported as failed until it is. Reports to the service manager that
/// started the process, too: ready when all services are active.
class Heartbeat {
 public:
  Heartbeat(Participant& participant, std::string_view name_space);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// Before start(). Both are there until stop() has returned.
  void add(ServiceRecord& record, const Pulse& pulse);
  void start();
  /// Nothing is published any more.
  void stop();
  /// The end of the process has begun: what is in flight is processed.
  void stopping() { supervisor_.stopping(); }
  /// The last heartbeat of a service, acknowledged by those who listen or given up after half a
  /// second.
  void finish(ServiceRecord& record, msg::ServiceState state, const std::string& detail = "");

 private:
  struct Entry {
    ServiceRecord* record;
    const Pulse* pulse;
    msg::ServiceStatus status;  // as last published
    bool finished = false;
  };

  void run();
  void publish_all();
  void publish(Entry& entry);
  void report();
  [[nodiscard]] bool alive(Pulse::Clock::time_point now, Pulse::Clock::duration allowance) const;

  std::mutex write_mutex_;  // heartbeats leave in the order of their snapshots
  Writer<msg::ServiceStatus> writer_;
  std::vector<Entry> entries_;
  SupervisorLink supervisor_;
  MemoryTrim memory_trim_;
  bool ready_ = false;
  std::string reported_;          // what the service manager knows
  std::int64_t reported_at_ = 0;  // [ns since the Unix epoch]
  std::mutex mutex_;
  std::condition_variable changed_;
  bool changed_state_ = false;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace quoin::runtime
