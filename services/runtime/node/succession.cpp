// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/succession.hpp"

#include <chrono>
#include <stdexcept>
#include <string>

namespace quoin::runtime {

namespace {
// A source may have to let a motor stop before it releases its device.
constexpr std::chrono::seconds patience{5};
}  // namespace

bool Succession::handle(const msg::ControlRequest& request, msg::ControlReply& reply) {
  switch (request.action()) {
    case msg::ControlAction::CONTROL_HOLD: {
      const std::lock_guard lock(mutex_);
      if (!held()) throw std::runtime_error("is at work already; only a held process can hold");
      keeping_ = true;
      reply.held_scans(kept_);
      reply.first_sequence_number(first_kept_);
      return true;
    }
    case msg::ControlAction::CONTROL_TAKE_OVER: {
      const std::lock_guard lock(mutex_);
      if (!held()) throw std::runtime_error("is at work already");
      begin_ = request.sequence_number();
      reply.first_sequence_number(request.sequence_number());
      if (callback_) callback_();
      return true;
    }
    case msg::ControlAction::CONTROL_HAND_OVER:
      hand_over(request.sequence_number(), reply);
      return true;
    default:
      return false;
  }
}

void Succession::hand_over(std::uint64_t from, msg::ControlReply& reply) {
  if (held()) throw std::runtime_error("has nothing to hand over: it is held itself");
  std::unique_lock lock(mutex_);
  leave_from_ = from;
  asked_.store(true, std::memory_order_release);
  if (callback_) callback_();
  if (!changed_.wait_for(lock, patience, [this] { return next_.has_value(); })) {
    asked_ = false;
    throw std::runtime_error("has not come to scan " + std::to_string(from) + " within " +
                             std::to_string(patience.count()) + " s");
  }
  reply.first_sequence_number(*next_);
}

void Succession::on_request(std::function<void()> callback) {
  const std::lock_guard lock(mutex_);
  callback_ = std::move(callback);
  if (callback_ && (begin_ || asked_)) callback_();
}

bool Succession::keep(std::uint64_t sequence_number) {
  const std::lock_guard lock(mutex_);
  if (keeping_ && kept_ > 0) {
    ++kept_;
    return true;
  }
  kept_ = 1;
  first_kept_ = sequence_number;
  return false;
}

std::optional<std::uint64_t> Succession::begin() {
  const std::lock_guard lock(mutex_);
  if (begin_) held_.store(false, std::memory_order_release);
  return begin_;
}

void Succession::left(std::uint64_t next) {
  const std::lock_guard lock(mutex_);
  next_ = next;
  changed_.notify_all();
}

}  // namespace quoin::runtime
