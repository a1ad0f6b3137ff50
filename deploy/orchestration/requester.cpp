// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/requester.hpp"

#include <algorithm>
#include <unistd.h>

#include "services/deployment/deployment.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin::deploy {

using std::chrono::milliseconds;

namespace {
constexpr std::size_t most_replies = 1024;  // that nobody has asked for
}

DdsRequester::DdsRequester(runtime::Participant& participant, const std::string& name_space)
    : name_("quoin_" + std::to_string(::getpid()) + "_" + std::to_string(runtime::now_ns())),
      writer_(participant, control_request_topic(name_space), runtime::QosPreset::control),
      reader_(participant, control_reply_topic(name_space), runtime::QosPreset::control) {
  wait_set_.add(reader_);
}

std::uint64_t DdsRequester::send(msg::ControlRequest& request) {
  request.requester(name_);
  request.request(++number_);
  (void)writer_.write(request);  // what was not written gets no answer
  return number_;
}

std::optional<msg::ControlReply> DdsRequester::take(std::uint64_t number) {
  msg::ControlReply reply;
  while (reader_.take(reply)) {
    if (reply.requester() == name_) replies_[reply.request()] = reply;
    if (replies_.size() > most_replies) replies_.erase(replies_.begin());
  }
  const auto found = replies_.find(number);
  if (found == replies_.end()) return std::nullopt;
  return std::move(replies_.extract(found).mapped());
}

std::optional<msg::ControlReply> Requester::wait(std::uint64_t number, Clock::time_point deadline) {
  while (true) {
    if (auto reply = take(number)) return reply;
    if (now() >= deadline) return std::nullopt;
    wait_for_any(milliseconds(20));
  }
}

std::optional<msg::ControlReply> Requester::ask(msg::ControlRequest& request,
                                                Clock::time_point deadline) {
  return wait(send(request), deadline);
}

bool Requester::reach(const std::string& service, Clock::time_point deadline) {
  while (now() < deadline) {
    msg::ControlRequest question;
    question.service(service);
    question.action(msg::ControlAction::CONTROL_DESCRIBE);
    if (ask(question, std::min(deadline, now() + milliseconds(200)))) return true;
  }
  return false;
}

}  // namespace quoin::deploy
