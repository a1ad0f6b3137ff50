// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/accounting/source_ledger.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace quoin::runtime {

namespace {

std::uint64_t excess(std::uint64_t value, std::uint64_t over) {
  return value > over ? value - over : 0;
}

}  // namespace

// A process that a reader heard, and those after it of which it heard nothing until the next one.
struct SourceLedger::Interval {
  std::vector<std::uint64_t> incarnations;
  std::uint64_t accounted = 0;
  std::uint64_t offset = 0;
};

// Those of which nothing more will be heard.
std::vector<SourceLedger::Interval> SourceLedger::intervals(
    const std::vector<SourceAccount>& accounts, bool ended) const {
  std::vector<Interval> intervals;
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    const auto begin = processes_.find(accounts[i].incarnation);
    if (begin == processes_.end() || accounts[i].handed_over) continue;
    auto end = processes_.end();
    if (i + 1 < accounts.size()) {
      const SourceAccount& next = accounts[i + 1];
      if (next.begins || next.incarnation < accounts[i].incarnation) continue;
      end = processes_.lower_bound(next.incarnation);
    } else if (!ended) {
      continue;
    }
    Interval& interval = intervals.emplace_back();
    interval.accounted = accounts[i].accounted;
    interval.offset = accounts[i].offset;
    for (auto process = begin; process != end; ++process) {
      // One that was held while this one was started again took over later, though it is older.
      const bool heard = process != begin &&
                         std::ranges::find(accounts, process->first, &SourceAccount::incarnation) !=
                             accounts.end();
      if (!heard) interval.incarnations.push_back(process->first);
    }
  }
  return intervals;
}

std::uint64_t SourceLedger::published(const Interval& interval) const {
  std::uint64_t sum = 0;
  for (const std::uint64_t incarnation : interval.incarnations) {
    sum += processes_.at(incarnation).published;
  }
  return sum;
}

// Taken in the order of their ends, and each put right at its end, intervals need the least.
void SourceLedger::learn(const std::vector<const std::vector<SourceAccount>*>& readers) {
  std::multimap<std::uint64_t, Interval> proofs;  // by the last process
  for (const std::vector<SourceAccount>* accounts : readers) {
    for (const Interval& interval : intervals(*accounts, false)) {
      proofs.emplace(interval.incarnations.back(), interval);
    }
  }
  for (const auto& [last, interval] : proofs) {
    processes_.at(last).published += excess(interval.accounted, published(interval));
  }
}

std::uint64_t SourceLedger::published() const {
  std::uint64_t sum = 0;
  for (const auto& [incarnation, process] : processes_) sum += process.published;
  return sum;
}

std::uint64_t SourceLedger::scans() const {
  return scans_before(std::numeric_limits<std::uint64_t>::max());
}

std::uint64_t SourceLedger::scans_before(std::uint64_t incarnation) const {
  std::uint64_t sum = 0;
  auto process = processes_.begin();
  for (; process != processes_.end() && process->first < incarnation; ++process) {
    sum += process->second.published + process->second.lost;
  }
  return process == processes_.end() ? sum : excess(sum, process->second.first_number);
}

std::uint64_t SourceLedger::unaccounted(const std::vector<SourceAccount>& accounts,
                                        bool ended) const {
  std::uint64_t sum = 0;
  for (const Interval& interval : intervals(accounts, ended)) {
    const Process& first = processes_.at(interval.incarnations.front());
    sum += excess(published(interval), interval.accounted) +
           excess(first.first_number + first.lost, interval.offset);
    for (std::size_t i = 1; i < interval.incarnations.size(); ++i) {
      sum += processes_.at(interval.incarnations[i]).lost;
    }
  }
  return sum;
}

}  // namespace quoin::runtime
