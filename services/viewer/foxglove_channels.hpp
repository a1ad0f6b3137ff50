// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "services/topics/protobuf/views.hpp"
#include "services/viewer/hub.hpp"

namespace quoin::viewer {

/// What Foxglove and Lichtblick draw of the messages of topics: channels of Protobuf beside those
/// of the messages themselves. Nothing is converted that no client has asked for. For one thread.
class FoxgloveChannels {
 public:
  explicit FoxgloveChannels(Hub& hub) : hub_(hub) {}

  /// Adds the channels of a topic, <topic>/<view>, and one of transforms for all that have frames.
  /// `type`: of the table of topic types, or "status" for heartbeats, which have none.
  void add(const std::string& topic, const std::string& type);
  /// A message of the topic, and its frame if it has one.
  void publish(const std::string& topic, std::span<const std::byte> cdr, const std::string& frame,
               std::int64_t stamp);

 private:
  struct Topic {
    topics::Views views;
    std::vector<std::uint32_t> channels;  // by view
  };

  Hub& hub_;
  std::map<std::string, Topic> topics_;  // by name
  std::uint32_t transforms_ = 0;         // channel
};

}  // namespace quoin::viewer
