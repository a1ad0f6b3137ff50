// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/ports.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "services/runtime/node/clock.hpp"

namespace quoin::runtime {

namespace {

using Clock = std::chrono::steady_clock;

// A reader that is only slow makes room sooner.
constexpr std::chrono::seconds slow_reader_timeout{2};

/// Says once for whom a lossless writer waits, and takes it back.
class WaitNotice {
 public:
  explicit WaitNotice(DataThread& thread) : thread_(thread), begun_(thread.now()) {}
  ~WaitNotice() {
    if (!told_.empty()) thread_.record.set_detail(detail_before_);
  }
  WaitNotice(const WaitNotice&) = delete;
  WaitNotice& operator=(const WaitNotice&) = delete;

  void waiting(const std::vector<std::string>& silent) {
    if (thread_.now() - begun_ < slow_reader_timeout) return;
    std::string text = "waiting for readers that do not take its results";
    for (std::size_t i = 0; i < silent.size(); ++i) text += (i == 0 ? ": " : ", ") + silent[i];
    if (text == told_) return;
    spdlog::warn("{}", text);
    if (told_.empty()) detail_before_ = thread_.record.detail();
    thread_.record.set_detail(text);
    told_ = std::move(text);
  }

 private:
  DataThread& thread_;
  const Clock::time_point begun_;
  std::string told_;
  std::string detail_before_;
};

}  // namespace

bool deliver(Output& output, msg::StageTrace& trace, bool lossless, DataThread& thread) {
  thread.pulse.beat();
  trace.published(now_ns());
  if (output.write()) return true;
  if (!lossless) return false;
  WaitNotice notice(thread);
  auto deadline = Clock::time_point::max();
  while (true) {
    if (thread.stopping()) {
      const auto now = thread.now();
      if (deadline == Clock::time_point::max()) deadline = now + longest_wait_for_room;
      if (now >= deadline) return false;
    }
    notice.waiting(output.check_silent_readers());
    thread.pulse.beat();
    trace.published(now_ns());
    if (output.write()) return true;
  }
}

namespace {

// Ten seconds of a fast odometry, while nothing comes that asks for them.
constexpr std::size_t most_partners = 2048;

std::int64_t stamp_of(const Message& message) { return message.header->stamp(); }

}  // namespace

void Partners::add(Message message) {
  const auto at = std::ranges::upper_bound(messages_, stamp_of(message), {}, stamp_of);
  if (at != messages_.begin() && stamp_of(*std::prev(at)) == stamp_of(message)) {
    *std::prev(at) = std::move(message);
    return;
  }
  messages_.insert(at, std::move(message));
  if (messages_.size() > most_partners) messages_.pop_front();
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
