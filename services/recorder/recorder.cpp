// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/recorder/recorder.hpp"

#include <chrono>
#include <sys/utsname.h>
#include <utility>

#include "services/runtime/node/clock.hpp"
#include "services/topics/header.hpp"

namespace quoin {

namespace {

using sensor_bridge::mcap::WriteError;

// What is written is flushed so often: no more than that is lost when the process is killed.
constexpr std::chrono::milliseconds flush_period{500};

std::vector<RecordedTopic> with_heartbeats(std::vector<RecordedTopic> topics,
                                           const std::string& heartbeats) {
  if (!heartbeats.empty()) topics.push_back({heartbeats, "", &heartbeat_type, "state"});
  return topics;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const RecorderParameters& parameters,
                   const std::vector<RecordedTopic>& topics, RunFacts facts,
                   const std::string& heartbeats)
    : recording_(path, parameters, with_heartbeats(topics, heartbeats), std::move(facts)) {
  for (const RecordedTopic& topic : topics)
    accounts_.push_back({topic.topic, runtime::ScanAccounting(), 0, 0});
  figures_.file = recording_.file().string();
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() { finish(); }

void Recorder::record(std::size_t topic, const topics::RawMessage& raw, const msg::Header& header) {
  Account& account = accounts_.at(topic);
  std::uint64_t missed = 0;
  for (const runtime::Loss& loss : account.accounting.receive(header)) {
    if (loss.site.place == runtime::LossPlace::link) missed += loss.count;
  }
  if (account.accounting.verdict() != runtime::ScanAccounting::Verdict::received) return;
  account.missed += missed;

  {
    const std::lock_guard lock(mutex_);
    figures_.missed += missed;
  }
  MessageToRecord message;
  message.frame = header.frame();
  message.stamp = header.stamp();
  message.sequence_number = topics::sequence_number(header);
  if (enqueue(topic, raw, std::move(message))) ++account.recorded;
}

void Recorder::record_heartbeat(const msg::ServiceStatus& status) {
  topics::RawMessage raw;
  topics::encode(status, raw);
  raw.published = status.stamp();
  MessageToRecord message;
  message.stamp = status.stamp();
  (void)enqueue(accounts_.size(), raw, std::move(message));
}

/// False when there is no room.
bool Recorder::enqueue(std::size_t topic, const topics::RawMessage& raw, MessageToRecord message) {
  const std::lock_guard lock(mutex_);
  if (!figures_.stopped.empty() || waiting_ + raw.cdr.size() > most_waiting) {
    ++figures_.dropped;
    return false;
  }
  if (!spare_.empty()) {
    message.cdr = std::move(spare_.back());
    spare_.pop_back();
  }
  message.topic = topic;
  message.cdr.assign(raw.cdr.begin(), raw.cdr.end());
  message.published = raw.published;
  message.received = raw.received == 0 ? runtime::now_ns() : raw.received;
  waiting_ += message.cdr.size();
  const bool first = queue_.empty();
  queue_.push_back(std::move(message));
  if (first) changed_.notify_one();
  return true;
}

void Recorder::run() {
  std::deque<MessageToRecord> messages;
  auto flushed = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait_until(lock, flushed + flush_period,
                        [this] { return ending_ || !queue_.empty(); });
    std::swap(messages, queue_);
    const bool ending = ending_ && messages.empty();
    waiting_ = 0;
    const bool stopped = !figures_.stopped.empty();
    lock.unlock();
    if (!stopped) write(messages);
    const auto now = std::chrono::steady_clock::now();
    if (!stopped && now >= flushed + flush_period) {
      try {
        recording_.flush();
      } catch (const WriteError& error) {
        stop_recording(error.what());
      }
    }
    if (now >= flushed + flush_period) flushed = now;
    lock.lock();
    for (MessageToRecord& message : messages) {
      // As many as are usually on their way.
      if (spare_.size() < 64) spare_.push_back(std::move(message.cdr));
    }
    messages.clear();
    if (figures_.stopped.empty()) {
      figures_.bytes = recording_.size();
      figures_.file = recording_.file().string();
    }
    if (ending) return;
  }
}

void Recorder::write(std::deque<MessageToRecord>& messages) {
  std::uint64_t written = 0;
  try {
    for (const MessageToRecord& message : messages) {
      recording_.write(message);
      ++written;
    }
    const std::lock_guard lock(mutex_);
    figures_.recorded += written;
  } catch (const std::exception& error) {
    {
      const std::lock_guard lock(mutex_);
      figures_.recorded += written;
      figures_.dropped += messages.size() - written;
    }
    stop_recording(error.what());
  }
}

void Recorder::stop_recording(const std::string& why) {
  std::string text = why;
  try {
    recording_.finish({});
    text += "; '" + recording_.files().back().string() + "' is whole up to then";
  } catch (const std::exception& error) {
    text += "; " + std::string(error.what());
  }
  const std::lock_guard lock(mutex_);
  figures_.stopped = text;
}

void Recorder::finish() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_one();
  }
  thread_.join();
  if (!figures_.stopped.empty()) return;
  std::map<std::string, std::string> entries;
  for (const Account& account : accounts_) {
    if (account.accounting.received() == 0) continue;
    entries[account.topic] =
        "received " +
        std::to_string(account.accounting.received() - account.accounting.duplicates()) +
        ", recorded " + std::to_string(account.recorded) + ", missed " +
        std::to_string(account.missed);
  }
  try {
    recording_.finish({{"quoin.accounting", entries}});
    figures_.stopped = "finished";
    figures_.bytes = recording_.size();
  } catch (const std::exception& error) {
    figures_.stopped = error.what();
  }
}

Recorder::Figures Recorder::figures() const {
  const std::lock_guard lock(mutex_);
  return figures_;
}

std::vector<std::pair<std::string, std::string>> Recorder::diagnostics() {
  const auto now = std::chrono::steady_clock::now();
  if (now < diagnosed_ + std::chrono::seconds(1)) return {};
  diagnosed_ = now;
  const Figures now_known = figures();
  return {{"Recording", now_known.stopped.empty() ? now_known.file : now_known.stopped},
          {"Recorded Messages", std::to_string(now_known.recorded)},
          {"Missed Messages", std::to_string(now_known.missed)},
          {"Dropped Messages", std::to_string(now_known.dropped)},
          {"Recorded Bytes", std::to_string(now_known.bytes)}};
}

std::vector<std::filesystem::path> Recorder::files() const { return recording_.files(); }

RunFacts run_facts(const Deployment& deployment) {
  RunFacts facts;
  utsname host{};
  ::uname(&host);
  facts.metadata["quoin.host"] = {{"name", host.nodename},
                                  {"system", host.sysname},
                                  {"release", host.release},
                                  {"machine", host.machine}};
  facts.metadata["quoin.versions"] = {{"quoin", QUOIN_VERSION}};
  std::map<std::string, std::string> services;
  for (const ServiceConfig& service : deployment.services) {
    services[label(service)] = service.kind + (service.method.empty() ? "" : " " + service.method);
  }
  facts.metadata["quoin.services"] = std::move(services);
  facts.metadata["quoin.deployment"] = {{"file", deployment.file.string()},
                                        {"namespace", deployment.name_space},
                                        {"domain", std::to_string(deployment.domain)}};
  facts.deployment_name = deployment.file.filename().string();
  facts.deployment_text = read_deployment(deployment.file);
  return facts;
}

}  // namespace quoin
