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

/// Sends control requests to the services and supervisors of a running deployment and takes their
/// answers. What carries them and what time it is is left to a derived class: DdsRequester, or a
/// test.
class Requester {
 public:
  using Clock = std::chrono::steady_clock;

  Requester() = default;
  virtual ~Requester() = default;
  Requester(const Requester&) = delete;
  Requester& operator=(const Requester&) = delete;

  /// Sends what has its service and action; returns the number to ask for the answer with.
  virtual std::uint64_t send(msg::ControlRequest& request) = 0;
  /// The newest answer to that request that has come and was not taken yet.
  [[nodiscard]] virtual std::optional<msg::ControlReply> take(std::uint64_t number) = 0;
  /// What all deadlines are measured by.
  [[nodiscard]] virtual Clock::time_point now() const = 0;
  /// Returns when an answer may have come, at the latest after `timeout`.
  virtual void wait_for_any(std::chrono::milliseconds timeout) = 0;

  /// Waits for an answer to a request that was sent before.
  [[nodiscard]] std::optional<msg::ControlReply> wait(std::uint64_t number,
                                                      Clock::time_point deadline);
  /// Sends and waits for the answer.
  [[nodiscard]] std::optional<msg::ControlReply> ask(msg::ControlRequest& request,
                                                     Clock::time_point deadline);
  /// True once the service has answered anything: from then on no request is lost.
  [[nodiscard]] bool reach(const std::string& service, Clock::time_point deadline);
};

/// Over the control topics of a namespace.
class DdsRequester : public Requester {
 public:
  /// Throws std::runtime_error when DDS refuses.
  DdsRequester(runtime::Participant& participant, const std::string& name_space);

  std::uint64_t send(msg::ControlRequest& request) override;
  [[nodiscard]] std::optional<msg::ControlReply> take(std::uint64_t number) override;
  [[nodiscard]] Clock::time_point now() const override { return Clock::now(); }
  void wait_for_any(std::chrono::milliseconds timeout) override { wait_set_.wait(timeout); }

 private:
  std::string name_;
  runtime::Writer<msg::ControlRequest> writer_;
  runtime::Reader<msg::ControlReply> reader_;
  runtime::WaitSet wait_set_;
  std::uint64_t number_ = 0;
  std::map<std::uint64_t, msg::ControlReply> replies_;
};

}  // namespace quoin::deploy
