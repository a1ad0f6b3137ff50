// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/succession.hpp"

#include <stdexcept>
#include <utility>

namespace quoin::runtime {

namespace {

Positions positions_of(const std::vector<msg::PortPosition>& list) {
  Positions positions;
  for (const msg::PortPosition& position : list) {
    positions[position.port()] = position.sequence_number();
  }
  return positions;
}

void add(const std::string& port, std::uint64_t sequence_number, msg::ControlReply& reply) {
  msg::PortPosition& position = reply.positions().emplace_back();
  position.port(port);
  position.sequence_number(sequence_number);
  if (reply.positions().size() == 1) reply.first_sequence_number(sequence_number);
}

}  // namespace

bool Succession::handle(const msg::ControlRequest& request, msg::ControlReply& reply) {
  switch (request.action()) {
    case msg::ControlAction::CONTROL_HOLD: {
      const std::lock_guard lock(mutex_);
      if (!held()) throw std::runtime_error("is at work already; only a held process can hold");
      keeping_ = true;
      std::uint32_t count = 0;
      for (const auto& [port, kept] : kept_) {
        count += kept.count;
        add(port, kept.first, reply);
      }
      reply.held_scans(count);
      return true;
    }
    case msg::ControlAction::CONTROL_TAKE_OVER: {
      const std::lock_guard lock(mutex_);
      if (!held()) throw std::runtime_error("is at work already");
      begin_ = Begin{positions_of(request.positions()), request.state()};
      if (!request.positions().empty()) {
        reply.first_sequence_number(request.positions().front().sequence_number());
      }
      if (callback_) callback_();
      return true;
    }
    case msg::ControlAction::CONTROL_HAND_OVER:
      hand_over(request, reply);
      return true;
    default:
      return false;
  }
}

void Succession::hand_over(const msg::ControlRequest& request, msg::ControlReply& reply) {
  if (held()) throw std::runtime_error("has nothing to hand over: it is held itself");
  std::unique_lock lock(mutex_);
  leave_from_ = positions_of(request.positions());
  asked_.store(true, std::memory_order_release);
  if (callback_) callback_();
  if (!changed_.wait_for(lock, longest_handover_, [this] { return next_.has_value(); })) {
    asked_ = false;
    std::string until = "the end of what it is doing";
    if (!leave_from_.empty()) until = "scan " + std::to_string(leave_from_.begin()->second);
    throw std::runtime_error("has not come to " + until + " within " +
                             std::to_string(longest_handover_.count()) + " ms");
  }
  for (const auto& [port, sequence_number] : *next_) add(port, sequence_number, reply);
  reply.state(state_);
}

void Succession::on_request(std::function<void()> callback) {
  const std::lock_guard lock(mutex_);
  callback_ = std::move(callback);
  if (callback_ && (begin_ || asked_)) callback_();
}

bool Succession::keep(const std::string& port, std::uint64_t sequence_number) {
  const std::lock_guard lock(mutex_);
  Kept& kept = kept_[port];
  if (keeping_ && kept.count > 0) {
    ++kept.count;
    return true;
  }
  kept = {1, sequence_number};
  return false;
}

std::optional<Succession::Begin> Succession::begin() {
  const std::lock_guard lock(mutex_);
  if (begin_) held_.store(false, std::memory_order_release);
  return begin_;
}

bool Succession::leaves(const std::string& port, std::uint64_t sequence_number) const {
  if (!asked()) return false;
  const std::lock_guard lock(mutex_);
  const auto from = leave_from_.find(port);
  return from == leave_from_.end() || sequence_number >= from->second;
}

void Succession::left(const Positions& next, State state) {
  const std::lock_guard lock(mutex_);
  next_ = next;
  state_ = std::move(state);
  changed_.notify_all();
}

}  // namespace quoin::runtime
