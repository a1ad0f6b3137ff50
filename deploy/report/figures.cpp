// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/report/figures.hpp"

namespace quoin::deploy {

std::map<std::uint64_t, ServiceReport> Incarnations::processes() const {
  std::map<std::uint64_t, ServiceReport> processes = reports_;
  for (const auto& [incarnation, count] : published_at_least_) {
    ServiceReport& process = processes[incarnation];  // may have died before its first heartbeat
    process.published = std::max(process.published, count);
  }
  return processes;
}

ServiceReport Incarnations::total() const {
  ServiceReport total;
  if (!reports_.empty()) total = reports_.rbegin()->second;
  total.published = 0;
  for (const auto& [incarnation, process] : processes()) {
    total.published += process.published;
    if (reports_.empty() || incarnation == reports_.rbegin()->first) continue;
    total.received += process.received;
    total.lost += process.lost;
    total.upstream_lost += process.upstream_lost;
    total.failures += process.failures;
    for (const auto& [cause, count] : process.losses) total.losses[cause] += count;
  }
  return total;
}

}  // namespace quoin::deploy
