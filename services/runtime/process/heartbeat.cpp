// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/heartbeat.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <unistd.h>
#include <utility>

#include <spdlog/spdlog.h>

#include "services/runtime/process/clock.hpp"
#include "services/runtime/dds/interfaces.hpp"

namespace quoin::runtime {

namespace {

constexpr std::chrono::seconds period{1};
constexpr std::array<const char*, 3> cause_names{"link", "processing", "publishing"};

double seconds(std::int64_t from, std::int64_t to) { return static_cast<double>(to - from) * 1e-9; }

}  // namespace

std::string state_name(msg::ServiceState state) {
  switch (state) {
    case msg::STATE_STARTING:
      return "starting";
    case msg::STATE_HELD:
      return "held";
    case msg::STATE_ACTIVE:
      return "active";
    case msg::STATE_FINISHED:
      return "finished";
    case msg::STATE_STOPPED:
      return "stopped";
    case msg::STATE_FAILED:
      return "failed";
  }
  return "unknown";
}

Heartbeat::Heartbeat(Participant& participant, const Deployment& deployment,
                     const ServiceConfig& config)
    : incarnation_(static_cast<std::uint64_t>(now_ns())),
      rate_since_(now_ns()),
      writer_(participant, status_topic(deployment.name_space), QosPreset::state) {
  status_.service(label(config));
  status_.kind(config.kind);
  status_.method(config.method);
  status_.host(host_name());
  status_.pid(static_cast<std::uint32_t>(getpid()));
  status_.incarnation(incarnation_);
  status_.state(msg::ServiceState::STATE_STARTING);
  thread_ = std::thread([this] { run(); });
}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void Heartbeat::set_state(msg::ServiceState state, const std::string& detail) {
  {
    const std::lock_guard lock(mutex_);
    status_.state(state);
    status_.detail(detail);
    changed_state_ = true;
    changed_.notify_all();
  }
  if (state == msg::ServiceState::STATE_ACTIVE) supervisor_.ready();
}

void Heartbeat::set_detail(const std::string& detail) {
  const std::lock_guard lock(mutex_);
  status_.detail(detail);
}

void Heartbeat::set_method(const std::string& method) {
  const std::lock_guard lock(mutex_);
  status_.method(method);
}

void Heartbeat::set_first_sequence_number(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  status_.first_sequence_number(number);
}

void Heartbeat::set_diagnostic(const std::string& name, const std::string& value) {
  const std::lock_guard lock(mutex_);
  for (msg::Diagnostic& diagnostic : status_.diagnostics()) {
    if (diagnostic.name() == name) {
      diagnostic.value(value);
      return;
    }
  }
  msg::Diagnostic diagnostic;
  diagnostic.name(name);
  diagnostic.value(value);
  status_.diagnostics().push_back(diagnostic);
}

void Heartbeat::set_endpoint_report(std::function<void(msg::ServiceStatus&)> report) {
  const std::lock_guard lock(mutex_);
  endpoint_report_ = std::move(report);
}

void Heartbeat::count_received(std::uint64_t upstream_lost, std::uint64_t link_lost) {
  const std::lock_guard lock(mutex_);
  ++status_.received();
  status_.upstream_lost() += upstream_lost;
  losses_[static_cast<std::size_t>(LossCause::link)] += link_lost;
}

void Heartbeat::count_loss(LossCause cause) {
  const std::lock_guard lock(mutex_);
  ++losses_[static_cast<std::size_t>(cause)];
}

void Heartbeat::count_control_drop() {
  const std::lock_guard lock(mutex_);
  ++status_.control_dropped();
}

void Heartbeat::count_published(std::int64_t scan_published, std::int64_t received,
                                std::int64_t published, std::size_t failures) {
  const std::lock_guard lock(mutex_);
  ++status_.published();
  status_.failures() += failures;
  latency_.add(seconds(scan_published, published));
  processing_.add(seconds(received, published));
}

msg::ServiceStatus Heartbeat::snapshot() {
  const std::uint64_t resident = resident_memory();
  const std::lock_guard lock(mutex_);
  changed_state_ = false;
  const std::int64_t now = now_ns();
  const double elapsed = seconds(rate_since_, now);
  if (elapsed >= 0.5) {  // heartbeats at changes of state come too close for a rate
    status_.rate(static_cast<double>(status_.published() - rate_published_) / elapsed);
    rate_published_ = status_.published();
    rate_since_ = now;
  }
  status_.stamp(now);
  std::uint64_t lost = 0;
  status_.losses().clear();
  for (std::size_t i = 0; i < cause_names.size(); ++i) {
    if (losses_[i] == 0) continue;
    lost += losses_[i];
    msg::LossCount count;
    count.cause(cause_names[i]);
    count.count(losses_[i]);
    status_.losses().push_back(count);
  }
  status_.lost(lost);
  status_.latency_p50(latency_.quantile(0.5));
  status_.latency_p99(latency_.quantile(0.99));
  status_.processing_p50(processing_.quantile(0.5));
  status_.processing_p99(processing_.quantile(0.99));
  status_.resident_memory(resident);
  const std::vector<std::string> known_misfits = status_.incompatible_qos();
  if (endpoint_report_) endpoint_report_(status_);
  for (const std::string& misfit : status_.incompatible_qos()) {
    if (std::find(known_misfits.begin(), known_misfits.end(), misfit) == known_misfits.end()) {
      spdlog::warn("QoS does not match: {}", misfit);
    }
  }
  return status_;
}

void Heartbeat::run() {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      if (ending_) return;
    }
    {
      const std::lock_guard lock(write_mutex_);
      const msg::ServiceStatus status = snapshot();
      writer_.write(status);
      tell_supervisor(status);
    }
    memory_trim_.tick();
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, period, [this] { return ending_ || changed_state_; });
  }
}

void Heartbeat::tell_supervisor(const msg::ServiceStatus& status) {
  std::string text = state_name(status.state());
  if (!status.detail().empty()) text += ": " + status.detail();
  // The service manager writes each of these down.
  if (text == told_ && seconds(told_at_, status.stamp()) < 10.0) return;
  told_ = text;
  told_at_ = status.stamp();
  std::array<char, 96> counts{};
  std::snprintf(counts.data(), counts.size(), "; %.1f Hz, %llu published, %llu lost", status.rate(),
                static_cast<unsigned long long>(status.published()),
                static_cast<unsigned long long>(status.lost()));
  supervisor_.status(text + counts.data());
}

void Heartbeat::finish(msg::ServiceState state, const std::string& detail) {
  {
    const std::lock_guard lock(mutex_);
    status_.state(state);
    status_.detail(detail);
    ending_ = true;
    changed_.notify_all();
  }
  supervisor_.stopping();
  const std::lock_guard lock(write_mutex_);
  const msg::ServiceStatus status = snapshot();
  writer_.write(status);
  tell_supervisor(status);
  writer_.wait_for_acknowledgments(std::chrono::milliseconds(500));
}

}  // namespace quoin::runtime
