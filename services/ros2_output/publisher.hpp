// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "services/deployment/deployment.hpp"
#include "services/ros2_output/parameters.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin {

/// Publishes the outputs of services as messages of ROS 2, with their stamps and frames. What
/// nobody reads is not converted, but for what late readers are to get. One thread at a time.
class Ros2Publisher {
 public:
  /// `service`: an observer of `deployment`. Throws std::runtime_error when DDS refuses to create
  /// the entities.
  Ros2Publisher(runtime::Participant& participant, const Deployment& deployment,
                const ServiceConfig& service, const Ros2OutputParameters& parameters);
  ~Ros2Publisher();
  Ros2Publisher(const Ros2Publisher&) = delete;
  Ros2Publisher& operator=(const Ros2Publisher&) = delete;

  /// A message of one of the observed topics, as it was sent by whomever. False when it is none of
  /// the topic's type.
  [[nodiscard]] bool handle(const std::string& topic, const topics::RawMessage& raw);

  /// By topic of ROS 2: its readers, and the messages that were written.
  struct Count {
    std::size_t readers = 0;
    std::uint64_t written = 0;
  };
  [[nodiscard]] std::map<std::string, Count> counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quoin
