// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Status.h>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "services/runtime/dds/writer.hpp"
#include "services/runtime/node/service_record.hpp"
#include "services/runtime/process/memory.hpp"
#include "services/runtime/process/supervisor_link.hpp"

namespace quoin::runtime {

/// Publishes the record of a service once a second and at each change of state, from a thread of
/// its own so that the data path never waits for it. Tells the service manager that started the
/// process, too: ready when active.
class Heartbeat {
 public:
  Heartbeat(Participant& participant, std::string_view name_space, ServiceRecord& record);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// Sign of life of the thread that data passes through.
  [[nodiscard]] Pulse& pulse() { return supervisor_.pulse(); }
  /// The end has begun: what is in flight is processed.
  void stopping() { supervisor_.stopping(); }
  /// The last heartbeat, acknowledged by those who listen or given up after half a second.
  void finish(msg::ServiceState state, const std::string& detail = "");

 private:
  void run();
  void publish();
  void tell_supervisor(const msg::ServiceStatus& status);

  ServiceRecord& record_;
  std::mutex write_mutex_;  // heartbeats leave in the order of their snapshots
  Writer<msg::ServiceStatus> writer_;
  SupervisorLink supervisor_;
  MemoryTrim memory_trim_;
  bool ready_ = false;
  std::string told_;          // state and detail that the supervisor knows
  std::int64_t told_at_ = 0;  // [ns since the Unix epoch]
  std::thread thread_;
};

}  // namespace quoin::runtime
