// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <idl/Status.h>
#include <string>
#include <thread>

#include "services/recorder/recorder.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin {

/// Brings the heartbeats of a deployment to a recorder, in a thread of its own.
class HeartbeatFeed {
 public:
  HeartbeatFeed(runtime::Participant& participant, const std::string& name_space,
                Recorder& recorder);
  ~HeartbeatFeed();
  HeartbeatFeed(const HeartbeatFeed&) = delete;
  HeartbeatFeed& operator=(const HeartbeatFeed&) = delete;

 private:
  void run();

  Recorder& recorder_;
  runtime::Reader<msg::ServiceStatus> reader_;
  runtime::WaitSet wait_set_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace quoin
