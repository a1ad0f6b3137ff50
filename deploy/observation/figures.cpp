// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/figures.hpp"

namespace quoin::deploy {

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
  if (!reports_.empty()) total = reports_.rbegin()->second;
  for (auto report = reports_.begin(); report != reports_.end(); ++report) {
    if (std::next(report) == reports_.end()) break;
    const ServiceReport& older = report->second;
    total.received += older.received;
    total.published += older.published;
    total.lost += older.lost;
    total.upstream_lost += older.upstream_lost;
    total.failures += older.failures;
    for (const auto& [cause, count] : older.losses) total.losses[cause] += count;
  }
  for (const auto& [key, count] : published_at_least_) {
    if (key.second != topic_) continue;
    const auto report = reports_.find(key.first);
    const std::uint64_t told = report == reports_.end() ? 0 : report->second.published;
    total.published += std::max(count, told) - told;
  }
  return total;
}

}  // namespace quoin::deploy
