// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <idl/Control.h>
#include <map>
#include <optional>
#include <string>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::deploy {

/// Sends control requests to the services of a running deployment and takes their answers.
class Requester {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws std::runtime_error when DDS refuses.
  Requester(runtime::Participant& participant, const std::string& name_space);

  /// Sends what has its service and action; returns the number to ask for the answer with.
  std::uint64_t send(msg::ControlRequest& request);
  /// The newest answer to that request that has come and was not taken yet.
  [[nodiscard]] std::optional<msg::ControlReply> take(std::uint64_t number);

  /// Sends and waits for the answer.
  [[nodiscard]] std::optional<msg::ControlReply> ask(msg::ControlRequest& request,
                                                     Clock::time_point deadline);
  /// Waits for an answer to a request that was sent before.
  [[nodiscard]] std::optional<msg::ControlReply> wait(std::uint64_t number,
                                                      Clock::time_point deadline);
  /// True once the service has answered anything: from then on no request is lost.
  [[nodiscard]] bool reach(const std::string& service, Clock::time_point deadline);

 private:
  std::string name_;
  runtime::Writer<msg::ControlRequest> writer_;
  runtime::Reader<msg::ControlReply> reader_;
  runtime::WaitSet wait_set_;
  std::uint64_t number_ = 0;
  std::map<std::uint64_t, msg::ControlReply> replies_;
};

}  // namespace quoin::deploy
