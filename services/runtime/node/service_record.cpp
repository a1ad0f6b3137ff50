// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/service_record.hpp"

#include <algorithm>
#include <array>
#include <unistd.h>
#include <utility>

#include <spdlog/spdlog.h>

#include "core/text/printable.hpp"
#include "services/runtime/dds/interfaces.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin::runtime {

namespace {

constexpr std::array<const char*, 3> cause_names{"link", "processing", "publishing"};

constexpr std::int64_t longest_blocked = 2'000'000'000;  // [ns]
// Of what is written down for others, who refuse longer texts.
constexpr std::size_t longest_text = 4000;  // [byte]

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

ServiceRecord::ServiceRecord(const ServiceConfig& config)
    : incarnation_(static_cast<std::uint64_t>(now_ns())), rate_since_(now_ns()) {
  status_.service(label(config));
  status_.kind(config.kind);
  status_.method(config.method);
  status_.host(host_name());
  status_.version(QUOIN_VERSION);
  status_.dds(std::string(dds_version()));
  status_.pid(static_cast<std::uint32_t>(getpid()));
  status_.incarnation(incarnation_);
  status_.state(msg::ServiceState::STATE_STARTING);
}

void ServiceRecord::set_state(msg::ServiceState state, const std::string& detail) {
  const std::lock_guard lock(mutex_);
  status_.state(state);
  status_.detail(printable(detail, Lines::many, longest_text));
  if (on_change_) on_change_();
}

void ServiceRecord::set_detail(const std::string& detail) {
  const std::lock_guard lock(mutex_);
  status_.detail(printable(detail, Lines::many, longest_text));
}

std::string ServiceRecord::detail() const {
  const std::lock_guard lock(mutex_);
  return status_.detail();
}

void ServiceRecord::set_method(const std::string& method) {
  const std::lock_guard lock(mutex_);
  status_.method(method);
}

void ServiceRecord::set_first_sequence_number(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  status_.first_sequence_number(number);
}

void ServiceRecord::set_diagnostic(const std::string& name, const std::string& value) {
  const std::lock_guard lock(mutex_);
  for (msg::Diagnostic& diagnostic : status_.diagnostics()) {
    if (diagnostic.name() == name) {
      diagnostic.value(printable(value, Lines::many, longest_text));
      return;
    }
  }
  msg::Diagnostic& diagnostic = status_.diagnostics().emplace_back();
  diagnostic.name(name);
  diagnostic.value(printable(value, Lines::many, longest_text));
}

void ServiceRecord::set_endpoint_report(std::function<void(msg::ServiceStatus&)> report) {
  const std::lock_guard lock(mutex_);
  endpoint_report_ = std::move(report);
}

void ServiceRecord::add_input(const std::string& port, const std::string& topic) {
  const std::lock_guard lock(mutex_);
  msg::InputStatus& input = status_.inputs().emplace_back();
  input.port(port);
  input.topic(topic);
}

void ServiceRecord::add_output(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  status_.outputs().emplace_back().topic(topic);
}

void ServiceRecord::count_received(std::size_t input, bool each, std::uint64_t upstream_lost,
                                   std::uint64_t link_lost) {
  const std::lock_guard lock(mutex_);
  msg::InputStatus& port = status_.inputs()[input];
  ++port.received();
  if (each) {
    // Less than before when some of them turn out to be false.
    ++status_.received();
    status_.upstream_lost() += upstream_lost - port.upstream_lost();
    losses_[static_cast<std::size_t>(LossCause::link)] += link_lost - port.lost();
  }
  port.upstream_lost(upstream_lost);
  port.lost(link_lost);
}

void ServiceRecord::count_refused(std::size_t input, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (refused_.size() <= input) refused_.resize(input + 1);
  ++refused_[input][reason];
}

void add_refused(msg::InputStatus& input, const std::string& reason, std::uint64_t count) {
  const auto known = std::ranges::find_if(
      input.refused(), [&](const msg::LossCount& refused) { return refused.cause() == reason; });
  if (known != input.refused().end()) {
    known->count() += count;
    return;
  }
  msg::LossCount& refused = input.refused().emplace_back();
  refused.cause(reason);
  refused.count(count);
}

void ServiceRecord::log_refused() {
  for (const msg::InputStatus& input : status_.inputs()) {
    for (const msg::LossCount& refused : input.refused()) {
      std::uint64_t& logged = logged_refused_[input.port() + ": " + refused.cause()];
      if (refused.count() <= logged) continue;
      spdlog::warn("refused {} messages of port {}: {}", refused.count() - logged, input.port(),
                   refused.cause());
      logged = refused.count();
    }
  }
}

void ServiceRecord::look_whether_blocked(std::int64_t now) {
  std::uint64_t used = 0;
  std::uint64_t unused = 0;
  for (const msg::InputStatus& input : status_.inputs()) {
    used += input.received();
    unused += input.duplicates();
    for (const msg::LossCount& refused : input.refused()) unused += refused.count();
  }
  const bool came = std::exchange(unused_, unused) != unused;
  if (std::exchange(used_, used) != used) {
    unused_since_ = 0;
  } else if (came && unused_since_ == 0) {
    unused_since_ = now;
  }
  if (came) unused_last_ = now;
}

void ServiceRecord::count_duplicate(std::size_t input) {
  const std::lock_guard lock(mutex_);
  ++status_.inputs()[input].duplicates();
}

void ServiceRecord::count_unjoined(std::size_t input) {
  const std::lock_guard lock(mutex_);
  ++status_.inputs()[input].unjoined();
}

void ServiceRecord::count_loss(LossCause cause) {
  const std::lock_guard lock(mutex_);
  ++losses_[static_cast<std::size_t>(cause)];
}

void ServiceRecord::count_control_drop() {
  const std::lock_guard lock(mutex_);
  ++status_.control_dropped();
}

void ServiceRecord::count_output(std::size_t output, bool published) {
  const std::lock_guard lock(mutex_);
  msg::OutputStatus& topic = status_.outputs()[output];
  ++(published ? topic.published() : topic.lost());
}

void ServiceRecord::count_result(std::int64_t scan_published, std::int64_t received,
                                 std::int64_t published, std::size_t failures) {
  const std::lock_guard lock(mutex_);
  status_.failures() += failures;
  if (published == 0) return;
  ++status_.published();
  latency_.add(seconds(scan_published, published));
  processing_.add(seconds(received, published));
}

void ServiceRecord::on_change(std::function<void()> callback) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(callback);
}

msg::ServiceStatus ServiceRecord::snapshot() {
  const std::lock_guard lock(mutex_);
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
    msg::LossCount& count = status_.losses().emplace_back();
    count.cause(cause_names[i]);
    count.count(losses_[i]);
  }
  status_.lost(lost);
  status_.latency_p50(latency_.quantile(0.5));
  status_.latency_p99(latency_.quantile(0.99));
  status_.processing_p50(processing_.quantile(0.5));
  status_.processing_p99(processing_.quantile(0.99));
  const std::vector<std::string> known = status_.incompatible_qos();
  for (msg::InputStatus& input : status_.inputs()) input.refused().clear();
  if (endpoint_report_) endpoint_report_(status_);
  for (std::size_t i = 0; i < std::min(refused_.size(), status_.inputs().size()); ++i) {
    for (const auto& [reason, count] : refused_[i]) add_refused(status_.inputs()[i], reason, count);
  }
  for (const std::string& mismatch : status_.incompatible_qos()) {
    if (std::find(known.begin(), known.end(), mismatch) == known.end()) {
      spdlog::warn("QoS does not match: {}", mismatch);
    }
  }
  log_refused();
  look_whether_blocked(now);
  const bool blocked = status_.state() == msg::STATE_ACTIVE && unused_since_ != 0 &&
                       unused_last_ - unused_since_ >= longest_blocked &&
                       now - unused_last_ < longest_blocked;
  if (!blocked) return status_;
  msg::ServiceStatus failed = status_;
  failed.state(msg::STATE_FAILED);
  failed.detail("nothing that comes can be used: it came before, or is refused; see its inputs");
  return failed;
}

}  // namespace quoin::runtime
