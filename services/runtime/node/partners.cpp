// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/partners.hpp"

#include <algorithm>
#include <utility>

namespace quoin::runtime {

namespace {

// Ten seconds of a fast odometry, while nothing comes that asks for them.
constexpr std::size_t most_kept = 2048;

std::int64_t stamp_of(const Message& message) { return message.header->stamp(); }

}  // namespace

void Partners::add(Message message) {
  const auto at = std::ranges::upper_bound(messages_, stamp_of(message), {}, stamp_of);
  if (at != messages_.begin() && stamp_of(*std::prev(at)) == stamp_of(message)) {
    *std::prev(at) = std::move(message);
    return;
  }
  messages_.insert(at, std::move(message));
  if (messages_.size() > most_kept) messages_.pop_front();
}

const Message* Partners::latest() const { return messages_.empty() ? nullptr : &messages_.back(); }

const Message* Partners::before(std::int64_t stamp) const {
  const auto at = std::ranges::upper_bound(messages_, stamp, {}, stamp_of);
  return at == messages_.begin() ? nullptr : &*std::prev(at);
}

const Message* Partners::after(std::int64_t stamp) const {
  const auto at = std::ranges::lower_bound(messages_, stamp, {}, stamp_of);
  return at == messages_.end() ? nullptr : &*at;
}

// One that is older stays: it may be the nearest.
void Partners::forget_before(std::int64_t stamp) {
  while (messages_.size() > 1 && stamp_of(messages_[1]) <= stamp) messages_.pop_front();
}

void Partners::keep_latest() {
  while (messages_.size() > 1) messages_.pop_front();
}

}  // namespace quoin::runtime
