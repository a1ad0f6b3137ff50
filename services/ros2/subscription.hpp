// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "services/ros2/topics.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/process/activity.hpp"

namespace quoin::ros2 {

/// Watches a reader of a ROS 2 topic: says for what it waits and why that may not come, and counts
/// what was lost on the way by the numbers that DDS gives the messages of each writer.
class SubscriptionWatch {
 public:
  SubscriptionWatch(const Deployment& deployment, std::string topic)
      : deployment_(deployment), topic_(std::move(topic)) {}

  void count(const runtime::ReaderBase::Sample& sample);
  /// To be called often; looks once a second.
  void look(const runtime::ReaderBase& reader, runtime::Activity& service);
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::string reason(const runtime::ReaderBase& reader) const;

  const Deployment& deployment_;
  const std::string topic_;
  std::map<std::uint64_t, std::uint64_t> newest_;  // by writer
  std::uint64_t lost_ = 0;
  Clock::time_point next_look_{};
  Clock::time_point alone_since_ = Clock::now();
  bool warned_ = false;
};

/// Reads a topic of ROS 2 for the body of a source. `T` is one of messages.hpp.
template <class T>
class Subscription {
 public:
  /// `deployment` outlives it. `owner`: label of the service. `topic` as ROS 2 names it. Throws
  /// std::runtime_error when DDS refuses to create the entities.
  Subscription(runtime::Participant& participant, const Deployment& deployment,
               const std::string& owner, const std::string& topic, bool reliable)
      : reader_(participant, dds_topic(topic), reader_qos(topic_type<T>(), reliable, owner)),
        watch_(deployment, topic) {
    wait_set_.add(reader_);
  }
  ~Subscription() { wait_set_.remove(reader_); }
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;

  /// Until something may be there to take; false when the service is asked to stop.
  [[nodiscard]] bool wait(runtime::Activity& service) {
    (void)wait_set_.wait(std::chrono::milliseconds(100));
    watch_.look(reader_, service);
    return service.wait_until(std::chrono::steady_clock::now());
  }
  /// The next message, until the next call; null when there is none.
  [[nodiscard]] const T* take() {
    if (!reader_.take(message_)) return nullptr;
    watch_.count(reader_.last_sample());
    return &message_;
  }
  /// [ns since the Unix epoch] when that message came.
  [[nodiscard]] std::int64_t received() const { return reader_.last_sample().received; }
  [[nodiscard]] std::uint64_t lost() const { return watch_.lost(); }

 private:
  runtime::Reader<T> reader_;
  runtime::WaitSet wait_set_;
  SubscriptionWatch watch_;
  T message_;
};

}  // namespace quoin::ros2
