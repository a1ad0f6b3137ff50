// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/figures.hpp"

namespace quoin::deploy {

namespace {
constexpr const char* held_state = "held";
}

std::map<std::uint64_t, ServiceReport> Incarnations::processes() const {
  std::map<std::uint64_t, ServiceReport> processes = reports_;
  for (const auto& [key, count] : published_at_least_) {
    ServiceReport& process = processes[key.first];  // may have died before its first heartbeat
    OutputReport& output = process.outputs[key.second];
    output.published = std::max(output.published, count);
    if (key.second == topic_) process.published = std::max(process.published, count);
  }
  return processes;
}

ServiceReport Incarnations::total() const {
  ServiceReport total;
  const ServiceReport* newest = nullptr;
  for (const auto& [incarnation, report] : reports_) {
    // While a new process is held the one before does the work.
    if (newest == nullptr || report.state != held_state) newest = &report;
  }
  if (newest != nullptr) total = *newest;
  for (const auto& [incarnation, other] : reports_) {
    if (&other == newest) continue;
    total.received += other.received;
    total.published += other.published;
    total.lost += other.lost;
    total.upstream_lost += other.upstream_lost;
    total.failures += other.failures;
    for (const auto& [cause, count] : other.losses) total.losses[cause] += count;
    for (const auto& [topic, output] : other.outputs) {
      total.outputs[topic].published += output.published;
      total.outputs[topic].lost += output.lost;
    }
  }
  for (const auto& [key, count] : published_at_least_) {
    if (key.second != topic_) continue;
    const auto report = reports_.find(key.first);
    const std::uint64_t reported = report == reports_.end() ? 0 : report->second.published;
    total.published += std::max(count, reported) - reported;
  }
  return total;
}

}  // namespace quoin::deploy
