// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/heartbeat.hpp"

#include <array>
#include <chrono>
#include <cstdio>

namespace quoin::runtime {

namespace {
constexpr std::chrono::seconds period{1};
constexpr std::int64_t supervisor_period = 10'000'000'000;  // [ns]
}  // namespace

Heartbeat::Heartbeat(Participant& participant, std::string_view name_space, ServiceRecord& record)
    : record_(record), writer_(participant, status_topic(name_space), QosPreset::state) {
  thread_ = std::thread([this] { run(); });
}

Heartbeat::~Heartbeat() {
  record_.close();
  thread_.join();
}

void Heartbeat::run() {
  while (!record_.closed()) {
    publish();
    memory_trim_.tick();
    record_.wait_for_change(period);
  }
}

void Heartbeat::publish() {
  const std::lock_guard lock(write_mutex_);
  msg::ServiceStatus status = record_.snapshot();
  status.resident_memory(resident_memory());
  writer_.write(status);
  tell_supervisor(status);
}

void Heartbeat::tell_supervisor(const msg::ServiceStatus& status) {
  if (!ready_ && status.state() == msg::ServiceState::STATE_ACTIVE) {
    ready_ = true;
    supervisor_.ready();
  }
  std::string text = state_name(status.state());
  if (!status.detail().empty()) text += ": " + status.detail();
  // The service manager writes each of these down.
  if (text == told_ && status.stamp() - told_at_ < supervisor_period) return;
  told_ = text;
  told_at_ = status.stamp();
  std::array<char, 96> counts{};
  std::snprintf(counts.data(), counts.size(), "; %.1f Hz, %llu published, %llu lost", status.rate(),
                static_cast<unsigned long long>(status.published()),
                static_cast<unsigned long long>(status.lost()));
  supervisor_.status(text + counts.data());
}

void Heartbeat::finish(msg::ServiceState state, const std::string& detail) {
  record_.set_state(state, detail);
  record_.close();
  supervisor_.stopping();
  publish();
  writer_.wait_for_acknowledgments(std::chrono::milliseconds(500));
}

}  // namespace quoin::runtime
