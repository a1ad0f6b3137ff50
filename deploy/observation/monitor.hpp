// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <idl/Common.h>
#include <idl/Corners.h>
#include <idl/Status.h>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "deploy/observation/deployment_record.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/process/heartbeat.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/message_check.hpp"

namespace quoin::deploy {

/// Reads the heartbeats of a deployment and what comes out at its ends into a record, in a thread
/// of its own.
class Monitor {
 public:
  /// Throws std::runtime_error when DDS refuses.
  Monitor(const Deployment& deployment, const std::string& host);
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  [[nodiscard]] DeploymentRecord& record() { return record_; }
  [[nodiscard]] const DeploymentRecord& record() const { return record_; }
  [[nodiscard]] runtime::Participant& participant() { return participant_; }

  /// After all services have ended: waits up to `timeout` for the last heartbeats of `names`, takes
  /// what has arrived, stops listening and closes the record.
  void finish(const std::vector<std::string>& names, std::chrono::milliseconds timeout);

 private:
  struct End {
    std::size_t number;  // of the record
    std::string type;    // of the table of topic types
    const topics::MessageCheck* check;
    runtime::RawReader reader;
  };
  void listen_to(std::size_t end, const Connection& connection);
  void listen();
  void take_all();
  void take_all(End& end);
  void stop();

  runtime::Participant participant_;
  runtime::Reader<msg::ServiceStatus> status_reader_;
  std::mutex ends_mutex_;
  std::vector<std::unique_ptr<End>> ends_;
  runtime::WaitSet wait_set_;
  runtime::MemoryTrim memory_trim_;
  DeploymentRecord record_;
  // Memory is kept from message to message.
  msg::ServiceStatus status_;
  topics::RawMessage raw_;
  msg::Header header_;
  msg::Corners corners_;
  msg::Pose pose_;
  msg::LineMap map_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace quoin::deploy
