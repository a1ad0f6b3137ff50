// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/subscription.hpp"

#include "services/ros2/reach.hpp"

namespace quoin::ros2 {

namespace {

// Discovery takes some 100 ms, on a busy machine some seconds.
constexpr std::chrono::seconds longest_discovery{5};

}  // namespace

void SubscriptionWatch::count(const runtime::ReaderBase::Sample& sample) {
  const auto [newest, first] = newest_.emplace(sample.writer, sample.sequence_number);
  if (!first && sample.sequence_number > newest->second) {
    lost_ += sample.sequence_number - newest->second - 1;
    newest->second = sample.sequence_number;
  }
}

std::string SubscriptionWatch::reason(const runtime::ReaderBase& reader) const {
  std::string text = "no writer of " + topic_;
  for (const std::string& mismatch : reader.incompatible_qos()) text += "; " + mismatch;
  for (const Obstacle& each : obstacles(deployment_, look_around())) {
    text += "; " + each.text + ": " + each.advice;
  }
  return text;
}

void SubscriptionWatch::look(const runtime::ReaderBase& reader, runtime::Activity& service) {
  const Clock::time_point now = Clock::now();
  if (now < next_look_) return;
  next_look_ = now + std::chrono::seconds(1);
  const std::size_t writers = reader.matched();
  service.set_diagnostic("Writers of " + topic_, std::to_string(writers));
  service.set_diagnostic("Lost on the way from " + topic_, std::to_string(lost_));
  if (writers > 0) {
    alone_since_ = now;
    if (warned_) service.clear_warning("a writer of " + topic_ + " is there");
    warned_ = false;
  } else if (!warned_ && now - alone_since_ > longest_discovery) {
    service.warn(reason(reader));
    warned_ = true;
  }
}

}  // namespace quoin::ros2
