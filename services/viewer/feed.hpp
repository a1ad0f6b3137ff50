// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <idl/Status.h>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/viewer/live_view.hpp"

namespace quoin::viewer {

/// Brings the heartbeats of a deployment, and outputs where they are asked for, to a live view, in
/// a thread of its own.
class Feed {
 public:
  struct Observed {
    OutputConfig output;
    runtime::TopicQos qos;
  };

  /// `every_second` is called by the thread.
  Feed(runtime::Participant& participant, LiveView& view, const std::string& name_space,
       const std::vector<Observed>& observed, std::function<void()> every_second = nullptr);
  ~Feed();
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;

 private:
  struct Topic {
    OutputConfig output;
    runtime::RawReader reader;
  };
  void run();
  void take_all();

  LiveView& view_;
  runtime::Reader<msg::ServiceStatus> status_reader_;
  std::vector<std::unique_ptr<Topic>> topics_;
  std::function<void()> every_second_;
  runtime::WaitSet wait_set_;
  msg::ServiceStatus status_;
  msg::Header header_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace quoin::viewer
