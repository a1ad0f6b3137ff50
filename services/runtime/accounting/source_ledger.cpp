// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/accounting/source_ledger.hpp"

#include <algorithm>
#include <limits>

namespace quoin::runtime {

namespace {

std::uint64_t excess(std::uint64_t value, std::uint64_t over) {
  return value > over ? value - over : 0;
}

}  // namespace

// The processes from one that a reader heard to the next one that it heard, without that.
struct SourceLedger::Interval {
  std::map<std::uint64_t, Process>::const_iterator begin;
  std::map<std::uint64_t, Process>::const_iterator end;
  std::uint64_t settled = 0;
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
    intervals.push_back({begin, end, accounts[i].settled, accounts[i].offset});
  }
  return intervals;
}

std::uint64_t SourceLedger::published(const Interval& interval) const {
  std::uint64_t sum = 0;
  for (auto process = interval.begin; process != interval.end; ++process) {
    sum += process->second.published;
  }
  return sum;
}

// Taken in the order of their ends, and each put right at its end, intervals need the least.
void SourceLedger::learn(const std::vector<const std::vector<SourceAccount>*>& readers) {
  std::multimap<std::uint64_t, Interval> proofs;  // by the last process
  for (const std::vector<SourceAccount>* accounts : readers) {
    for (const Interval& interval : intervals(*accounts, false)) {
      proofs.emplace(std::prev(interval.end)->first, interval);
    }
  }
  for (const auto& [last, interval] : proofs) {
    processes_.at(last).published += excess(interval.settled, published(interval));
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

std::uint64_t SourceLedger::unsettled(const std::vector<SourceAccount>& accounts,
                                      bool ended) const {
  std::uint64_t sum = 0;
  for (const Interval& interval : intervals(accounts, ended)) {
    const Process& first = interval.begin->second;
    sum += excess(published(interval), interval.settled) +
           excess(first.first_number + first.lost, interval.offset);
    for (auto later = std::next(interval.begin); later != interval.end; ++later) {
      sum += later->second.lost;
    }
  }
  return sum;
}

}  // namespace quoin::runtime
