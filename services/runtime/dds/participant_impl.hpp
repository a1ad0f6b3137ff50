// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include "services/runtime/dds/discovery.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin::runtime {

struct Participant::Impl {
  explicit Impl(std::unique_ptr<KnownEndpoints> others) : endpoints(std::move(others)) {}

  std::unique_ptr<KnownEndpoints> endpoints;  // outlives the participant, which calls it
  eprosima::fastdds::dds::DomainParticipant* participant = nullptr;
  eprosima::fastdds::dds::Publisher* publisher = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber = nullptr;
  Discovery discovery = Discovery::peers;
  std::chrono::steady_clock::time_point created;
  std::jthread answering;  // of an observer; ends before the participant

  /// The topic of this name, made at its first use, as its type is; `codec` is null for raw
  /// endpoints. Throws std::runtime_error, also when the topic has another type.
  eprosima::fastdds::dds::Topic* topic(const std::string& name, const std::string& type_name,
                                       const topics::CdrCodec* codec);
};

/// Number of peers of an endpoint, as its listener sees it.
class MatchState {
 public:
  void set_matched(int count);
  [[nodiscard]] std::size_t matched() const;
  [[nodiscard]] bool wait(std::size_t count, std::chrono::milliseconds timeout) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::size_t matched_ = 0;
};

}  // namespace quoin::runtime
