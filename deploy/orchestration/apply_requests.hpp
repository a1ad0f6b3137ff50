// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Control.h>
#include <optional>
#include <string>

#include "deploy/orchestration/composition.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::deploy {

/// What a request asks for, with whatever it carries brought within bounds.
[[nodiscard]] ApplyRequest apply_request(const msg::ControlRequest& request);

/// The control requests to the supervisor of a deployment.
class ApplyRequests {
 public:
  /// Throws std::runtime_error when DDS refuses.
  ApplyRequests(runtime::Participant& participant, const std::string& name_space, std::string name);

  /// The next request to apply a file. Others are answered: to describe with `file`.
  [[nodiscard]] std::optional<msg::ControlRequest> take(const std::string& file);
  /// Answers all that came: `current` is being carried out. Cues from its requester are kept.
  void attend(const msg::ControlRequest* current);
  /// Whether the instruction that came is to withdraw.
  [[nodiscard]] bool withdrawn() const;
  /// The next instruction for who is ready, and not taken yet.
  [[nodiscard]] std::optional<msg::ControlRequest> take_instruction();
  /// Fills in what every answer has.
  void reply(const msg::ControlRequest& request, msg::ControlReply reply);

 private:
  [[nodiscard]] bool next(msg::ControlRequest& request);
  void refuse(const msg::ControlRequest& request, const std::string& why);

  runtime::Writer<msg::ControlReply> writer_;
  runtime::Reader<msg::ControlRequest> reader_;
  std::string name_;  // what they are addressed to
  std::string file_;
  std::optional<msg::ControlRequest> cue_;
};

}  // namespace quoin::deploy
