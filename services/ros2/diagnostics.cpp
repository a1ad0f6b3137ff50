// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/diagnostics.hpp"

#include <cstdio>
#include <string>

#include "services/runtime/node/service_record.hpp"

namespace quoin::ros2 {

namespace {

constexpr std::int64_t stale_after = 3 * nanoseconds_a_second;

std::string text_of(double value) {
  char text[32];
  (void)std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::uint8_t level_of(const msg::ServiceStatus& in, std::int64_t age) {
  if (in.state() == msg::ServiceState::STATE_FAILED) return level_error;
  const bool ended = in.state() == msg::ServiceState::STATE_STOPPED ||
                     in.state() == msg::ServiceState::STATE_FINISHED;
  if (ended) return level_ok;
  if (age > stale_after) return level_stale;
  const bool doubtful = in.lost() > 0 || !in.detail().empty() || !in.incompatible_qos().empty();
  return doubtful ? level_warn : level_ok;
}

}  // namespace

void fill_diagnostic(const msg::ServiceStatus& in, std::int64_t age, std::string_view name_space,
                     DiagnosticStatus& out) {
  out.level(level_of(in, age));
  out.name(std::string(name_space) + "/" + in.service() + ": " + in.kind());
  std::string message = runtime::state_name(in.state());
  if (out.level() == level_stale)
    message = "silent for " + text_of(1e-9 * static_cast<double>(age)) + " s";
  if (!in.detail().empty()) message += ": " + in.detail();
  for (const std::string& mismatch : in.incompatible_qos()) message += "; " + mismatch;
  out.message(std::move(message));
  out.hardware_id(in.host());
  out.values().clear();
  const auto add = [&](const std::string& key, const std::string& value) {
    out.values().emplace_back();
    out.values().back().key(key);
    out.values().back().value(value);
  };
  if (!in.method().empty()) add("Method", in.method());
  add("Rate [Hz]", text_of(in.rate()));
  add("Received", std::to_string(in.received()));
  add("Published", std::to_string(in.published()));
  add("Lost", std::to_string(in.lost()));
  add("Parts without a result", std::to_string(in.failures()));
  add("Latency p50 [ms]", text_of(1e3 * in.latency_p50()));
  add("Latency p99 [ms]", text_of(1e3 * in.latency_p99()));
  for (const msg::Diagnostic& each : in.diagnostics()) add(each.name(), each.value());
}

}  // namespace quoin::ros2
