// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/supervisor_link.hpp"

#include <cstdint>
#include <systemd/sd-daemon.h>
#include <utility>

namespace quoin::runtime {

SupervisorLink::SupervisorLink(Alive alive) : alive_(std::move(alive)) {}

SupervisorLink::~SupervisorLink() { stop(); }

void SupervisorLink::stop() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  if (watchdog_.joinable()) watchdog_.join();
}

void SupervisorLink::ready() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(ready_, true)) return;
  }
  ::sd_notify(0, "READY=1");
  std::uint64_t period = 0;  // [us]
  if (::sd_watchdog_enabled(0, &period) > 0) {
    watchdog_ = std::thread([this, period] { watch(std::chrono::microseconds(period)); });
  }
}

void SupervisorLink::watch(std::chrono::microseconds period) {
  const auto half = period / 2;
  std::unique_lock lock(mutex_);
  while (!ending_) {
    if (alive_(Clock::now(), half)) {
      lock.unlock();
      ::sd_notify(0, "WATCHDOG=1");
      lock.lock();
    }
    changed_.wait_for(lock, half, [this] { return ending_; });
  }
}

void SupervisorLink::status(const std::string& text) const {
  std::string line = "STATUS=" + text;
  // A line feed would begin another field.
  for (char& character : line) {
    if (static_cast<unsigned char>(character) < ' ') character = ' ';
  }
  ::sd_notify(0, line.c_str());
}

void SupervisorLink::stopping() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(stopping_, true)) return;
  }
  ::sd_notify(0, "STOPPING=1");
}

}  // namespace quoin::runtime
