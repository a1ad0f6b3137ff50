// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/recorder/heartbeat_feed.hpp"

#include <chrono>

namespace quoin {

HeartbeatFeed::HeartbeatFeed(runtime::Participant& participant, const std::string& name_space,
                             Recorder& recorder)
    : recorder_(recorder),
      reader_(participant, status_topic(name_space), runtime::QosPreset::state) {
  wait_set_.add(reader_);
  thread_ = std::thread([this] { run(); });
}

HeartbeatFeed::~HeartbeatFeed() {
  ending_ = true;
  wait_set_.wake();
  thread_.join();
}

void HeartbeatFeed::run() {
  msg::ServiceStatus status;
  while (!ending_) {
    wait_set_.wait(std::chrono::seconds(1));
    while (reader_.take(status)) recorder_.record_heartbeat(status);
  }
}

}  // namespace quoin
