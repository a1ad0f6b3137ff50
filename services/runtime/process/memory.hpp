// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace quoin::runtime {

/// Physical memory of this process [byte].
[[nodiscard]] std::uint64_t resident_memory();

/// Gives back to the system what a burst has needed and is free again: the C library keeps what is
/// not at the end of a heap, and each burst may leave it in other places.
class MemoryTrim {
 public:
  using Clock = std::chrono::steady_clock;

  /// Large blocks and the ends of heaps are given back as soon as they are free from now on.
  explicit MemoryTrim(Clock::duration period = std::chrono::seconds(10));

  /// To be called now and then. Looks once in a period; when the process has grown since it was
  /// last trimmed, it is trimmed again, which takes a fraction of a millisecond.
  void tick();

 private:
  Clock::duration period_;
  Clock::time_point next_;
  std::uint64_t trimmed_to_ = 0;  // [byte]
};

}  // namespace quoin::runtime
