// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/apply_requests.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {
constexpr std::size_t longest_text = 4096;  // which every answer repeats

bool is_cue(const msg::ControlRequest& request) {
  return request.action() == msg::ControlAction::CONTROL_PROCEED ||
         request.action() == msg::ControlAction::CONTROL_WITHDRAW;
}
}  // namespace

ApplyRequest apply_request(const msg::ControlRequest& request) {
  ApplyRequest result;
  result.file = request.file();
  result.checksum = request.checksum();
  result.dry_run = request.dry_run();
  if (std::isfinite(request.wait())) {
    const std::chrono::duration<double> wait(std::clamp(request.wait(), 0.1, 600.0));
    result.timeout = std::chrono::duration_cast<std::chrono::milliseconds>(wait);
  }
  return result;
}

ApplyRequests::ApplyRequests(runtime::Participant& participant, const std::string& name_space,
                             std::string name)
    : writer_(participant, control_reply_topic(name_space), runtime::QosPreset::control),
      reader_(participant, control_request_topic(name_space), runtime::QosPreset::control),
      name_(std::move(name)) {}

// Answers what needs no work.
bool ApplyRequests::next(msg::ControlRequest& request) {
  while (reader_.take(request)) {
    if (request.service() != name_ || request.requester().size() > longest_text) continue;
    if (request.action() == msg::ControlAction::CONTROL_APPLY || is_cue(request)) return true;
    if (request.action() != msg::ControlAction::CONTROL_DESCRIBE) {
      refuse(request, "a supervisor can be asked to describe and to apply");
      continue;
    }
    msg::ControlReply answer;
    answer.accepted(true);
    answer.detail(file_);
    reply(request, answer);
  }
  return false;
}

void ApplyRequests::refuse(const msg::ControlRequest& request, const std::string& why) {
  msg::ControlReply answer;
  answer.detail(why);
  reply(request, answer);
}

std::optional<msg::ControlRequest> ApplyRequests::take(const std::string& file) {
  file_ = file;
  cue_.reset();
  msg::ControlRequest request;
  while (next(request)) {
    if (!is_cue(request)) return request;
    refuse(request, "nothing is being applied");
  }
  return std::nullopt;
}

void ApplyRequests::attend(const msg::ControlRequest* current) {
  msg::ControlRequest request;
  while (next(request)) {
    const bool from_requester = current != nullptr && request.requester() == current->requester();
    if (is_cue(request) && from_requester && !cue_) {
      cue_ = request;
    } else {
      refuse(request, "another file is being applied; ask again when that has ended");
    }
  }
}

bool ApplyRequests::withdrawn() const {
  return cue_ && cue_->action() == msg::ControlAction::CONTROL_WITHDRAW;
}

std::optional<msg::ControlRequest> ApplyRequests::take_instruction() {
  return std::exchange(cue_, {});
}

void ApplyRequests::reply(const msg::ControlRequest& request, msg::ControlReply reply) {
  reply.service(request.service());
  reply.requester(request.requester());
  reply.request(request.request());
  (void)writer_.write(reply);
}

}  // namespace quoin::deploy
