// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/quoin/apply_requests.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "deploy/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {
constexpr std::size_t longest_text = 4096;  // which every answer repeats
}

ApplyRequest apply_request(const msg::ControlRequest& request) {
  ApplyRequest result;
  result.file = request.file();
  result.checksum = request.checksum();
  result.dry_run = request.dry_run();
  if (std::isfinite(request.wait())) {
    const std::chrono::duration<double> wait(std::clamp(request.wait(), 0.1, 600.0));
    result.patience = std::chrono::duration_cast<std::chrono::milliseconds>(wait);
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
    if (request.action() == msg::ControlAction::CONTROL_APPLY) return true;
    msg::ControlReply answer;
    answer.accepted(request.action() == msg::ControlAction::CONTROL_DESCRIBE);
    answer.detail(answer.accepted() ? file_ : "a supervisor can be asked to describe and to apply");
    reply(request, answer);
  }
  return false;
}

std::optional<msg::ControlRequest> ApplyRequests::take(const std::string& file) {
  file_ = file;
  msg::ControlRequest request;
  if (!next(request)) return std::nullopt;
  return request;
}

void ApplyRequests::refuse() {
  msg::ControlRequest request;
  while (next(request)) {
    msg::ControlReply answer;
    answer.detail("another file is being applied; ask again when that has ended");
    reply(request, answer);
  }
}

void ApplyRequests::reply(const msg::ControlRequest& request, msg::ControlReply reply) {
  reply.service(request.service());
  reply.requester(request.requester());
  reply.request(request.request());
  (void)writer_.write(reply);
}

}  // namespace quoin::deploy
