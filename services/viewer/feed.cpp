// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/feed.hpp"

#include <chrono>
#include <utility>

#include "services/topics/cdr_codec.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::viewer {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

Feed::Feed(runtime::Participant& participant, LiveView& view, const std::string& name_space,
           const std::vector<Observed>& observed, std::function<void()> every_second)
    : view_(view),
      status_reader_(participant, status_topic(name_space), runtime::QosPreset::state),
      every_second_(std::move(every_second)) {
  wait_set_.add(status_reader_);
  for (const Observed& each : observed) {
    const std::string type(topics::find_topic_type(each.output.type)->dds_type);
    topics_.push_back(std::unique_ptr<Topic>(
        new Topic{each.output, {participant, each.output.topic, type, each.qos}}));
    wait_set_.add(topics_.back()->reader);
  }
  thread_ = std::thread([this] { run(); });
}

Feed::~Feed() {
  ending_ = true;
  wait_set_.wake();
  thread_.join();
}

void Feed::run() {
  auto due = Clock::now();
  while (!ending_) {
    wait_set_.wait(milliseconds(500));
    take_all();
    if (every_second_ && Clock::now() >= due) {
      every_second_();
      due = Clock::now() + std::chrono::seconds(1);
    }
  }
}

void Feed::take_all() {
  while (status_reader_.take(status_)) view_.publish(status_);
  for (const auto& topic : topics_) {
    while (true) {
      const auto raw = std::make_shared<topics::RawMessage>();
      if (!topic->reader.take(*raw)) break;
      if (!topics::read_header(*raw, header_)) continue;
      view_.publish(topic->output.topic, topic->output.type, raw, *raw, header_);
    }
  }
}

}  // namespace quoin::viewer
