// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/report/figures.hpp"

namespace quoin::deploy {

std::uint64_t Incarnations::published_by(std::uint64_t incarnation) const {
  const auto report = reports_.find(incarnation);
  const auto least = published_at_least_.find(incarnation);
  return std::max(report == reports_.end() ? 0 : report->second.published,
                  least == published_at_least_.end() ? 0 : least->second);
}

std::uint64_t Incarnations::numbered_by_newest() const {
  std::uint64_t newest = 0;
  if (!reports_.empty()) newest = reports_.rbegin()->first;
  if (!published_at_least_.empty()) newest = std::max(newest, published_at_least_.rbegin()->first);
  const auto report = reports_.find(newest);
  if (report == reports_.end()) return published_by(newest);
  return report->second.first_number + published_by(newest) + report->second.lost;
}

ServiceReport Incarnations::total() const {
  ServiceReport total;
  if (!reports_.empty()) total = reports_.rbegin()->second;
  total.published = 0;
  for (auto report = reports_.begin(); report != reports_.end(); ++report) {
    total.published += published_by(report->first);
    if (std::next(report) == reports_.end()) break;
    const ServiceReport& older = report->second;
    total.received += older.received;
    total.lost += older.lost;
    total.upstream_lost += older.upstream_lost;
    total.failures += older.failures;
    for (const auto& [cause, count] : older.losses) total.losses[cause] += count;
  }
  // Processes that died before their first heartbeat.
  for (const auto& [incarnation, count] : published_at_least_) {
    if (!reports_.contains(incarnation)) total.published += count;
  }
  return total;
}

}  // namespace quoin::deploy
