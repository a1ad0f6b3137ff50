// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "services/runtime/accounting/accounting.hpp"

namespace quoin::runtime {

/// Brings together what a source says of itself and what several readers saw of its scans, so that
/// for each reader the scans delivered and lost sum up to what the source published. A process that
/// is killed cannot report its last count, and of one that lived while a reader heard nothing, that
/// reader knows nothing at all.
class SourceLedger {
 public:
  /// One process of the source.
  struct Process {
    std::uint64_t first_number = 0;  ///< of its first scan; more than 0 when it took over numbers
    std::uint64_t published = 0;     ///< known so far
    std::uint64_t lost = 0;          ///< scans that it could not publish
  };

  void add(std::uint64_t incarnation, const Process& process) { processes_[incarnation] = process; }
  [[nodiscard]] bool knows(std::uint64_t incarnation) const {
    return processes_.contains(incarnation);
  }
  /// What the accounts of readers prove to have been published, even when nobody reported it: the
  /// least that agrees with all of them.
  void learn(const std::vector<const std::vector<SourceAccount>*>& readers);

  [[nodiscard]] std::uint64_t published() const;
  /// Published or lost by the source.
  [[nodiscard]] std::uint64_t scans() const;
  /// Published or lost by the source before that process, and not continued by its numbers.
  [[nodiscard]] std::uint64_t scans_before(std::uint64_t incarnation) const;
  /// Scans of a reader's accounts that it has neither accounted for nor will: they are behind the
  /// last one that it heard of a process, and it has heard of a later one, or `ended`.
  [[nodiscard]] std::uint64_t unaccounted(const std::vector<SourceAccount>& accounts,
                                          bool ended) const;

 private:
  struct Interval;
  [[nodiscard]] std::vector<Interval> intervals(const std::vector<SourceAccount>& accounts,
                                                bool ended) const;
  [[nodiscard]] std::uint64_t published(const Interval& interval) const;

  std::map<std::uint64_t, Process> processes_;  // by incarnation
};

}  // namespace quoin::runtime
