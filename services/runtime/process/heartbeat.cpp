// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/heartbeat.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <malloc.h>
#include <unistd.h>

namespace quoin::runtime {

namespace {

constexpr std::chrono::seconds period{1};
constexpr std::int64_t report_period = 10'000'000'000;  // [ns]
// A thread that has nothing to do says so every second.
constexpr std::chrono::seconds longest_silence{10};

bool has_ended(msg::ServiceState state) {
  return state == msg::ServiceState::STATE_FINISHED || state == msg::ServiceState::STATE_STOPPED ||
         state == msg::ServiceState::STATE_FAILED;
}

/// "active; 10.0 Hz, 120 published, 0 lost"
std::string to_text(const msg::ServiceStatus& status) {
  std::array<char, 96> counts{};
  std::snprintf(counts.data(), counts.size(), "; %.1f Hz, %llu published, %llu lost", status.rate(),
                static_cast<unsigned long long>(status.published()),
                static_cast<unsigned long long>(status.lost()));
  return counts.data();
}

}  // namespace

Heartbeat::Heartbeat(Participant& participant, std::string_view name_space)
    : writer_(participant, status_topic(name_space), QosPreset::state),
      supervisor_([this](auto now, auto allowance) { return alive(now, allowance); }) {}

Heartbeat::~Heartbeat() { stop(); }

void Heartbeat::stop() {
  for (const Entry& entry : entries_) entry.record->on_change(nullptr);
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  supervisor_.stop();
  entries_.clear();
}

void Heartbeat::add(ServiceRecord& record, const Pulse& pulse) {
  entries_.push_back({&record, &pulse, {}});
}

void Heartbeat::start() {
  for (const Entry& entry : entries_) {
    entry.record->on_change([this] {
      const std::lock_guard lock(mutex_);
      changed_state_ = true;
      changed_.notify_all();
    });
  }
  thread_ = std::thread([this] { run(); });
}

void Heartbeat::run() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    changed_state_ = false;
    lock.unlock();
    publish_all();
    memory_trim_.tick();
    lock.lock();
    changed_.wait_for(lock, period, [this] { return ending_ || changed_state_; });
  }
}

void Heartbeat::publish_all() {
  const std::lock_guard lock(write_mutex_);
  for (Entry& entry : entries_) {
    if (!entry.finished) publish(entry);
  }
  report();
}

void Heartbeat::publish(Entry& entry) {
  msg::ServiceStatus& status = entry.status;
  status = entry.record->snapshot();
  status.resident_memory(resident_memory());
  if (!has_ended(status.state()) && !entry.pulse->alive(Pulse::Clock::now(), longest_silence)) {
    status.state(msg::ServiceState::STATE_FAILED);
    status.detail("it hangs: nothing has been heard of its thread for more than " +
                  std::to_string(longest_silence.count()) + " s");
  }
  writer_.write(status);
}

/// To the service manager, which writes each text down.
void Heartbeat::report() {
  if (entries_.empty()) return;
  const auto has_begun = [](const Entry& entry) {
    return entry.status.state() == msg::ServiceState::STATE_ACTIVE ||
           entry.status.state() == msg::ServiceState::STATE_FINISHED;
  };
  if (!ready_ && std::ranges::all_of(entries_, has_begun)) {
    ready_ = true;
    supervisor_.ready();
  }
  std::string text;
  std::string counts;
  for (const Entry& entry : entries_) {
    if (entries_.size() > 1) text += (text.empty() ? "" : ", ") + entry.status.service() + " ";
    text += state_name(entry.status.state());
    if (!entry.status.detail().empty()) text += ": " + entry.status.detail();
    if (entries_.size() == 1) counts = to_text(entry.status);
  }
  const std::int64_t now = entries_.front().status.stamp();
  if (text == reported_ && now - reported_at_ < report_period) return;
  reported_ = text;
  reported_at_ = now;
  supervisor_.status(text + counts);
}

/// Where one of several services hangs, the others go on.
bool Heartbeat::alive(Pulse::Clock::time_point now, Pulse::Clock::duration allowance) const {
  return std::ranges::any_of(
      entries_, [&](const Entry& entry) { return entry.pulse->alive(now, allowance); });
}

void Heartbeat::finish(ServiceRecord& record, msg::ServiceState state, const std::string& detail) {
  record.set_state(state, detail);
  {
    const std::lock_guard lock(write_mutex_);
    const auto entry = std::ranges::find(entries_, &record, &Entry::record);
    if (entry == entries_.end() || entry->finished) return;
    publish(*entry);
    entry->finished = true;
    report();
  }
  writer_.wait_for_acknowledgments(std::chrono::milliseconds(500));
}

namespace {
constexpr std::uint64_t worth_it = 128U << 10U;  // [byte]

// [byte] The C library's own, which it raises to what has ever been allocated and freed at once.
constexpr int threshold = 128 << 10;
}  // namespace

std::uint64_t resident_memory() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0;
  std::uint64_t resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

MemoryTrim::MemoryTrim(Clock::duration period) : period_(period), next_(Clock::now() + period) {
  ::mallopt(M_MMAP_THRESHOLD, threshold);
  ::mallopt(M_TRIM_THRESHOLD, threshold);
}

void MemoryTrim::tick() {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + period_;
  if (resident_memory() < trimmed_to_ + worth_it) return;
  ::malloc_trim(0);
  trimmed_to_ = resident_memory();
}

}  // namespace quoin::runtime
