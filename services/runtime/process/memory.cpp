// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/memory.hpp"

#include <fstream>
#include <malloc.h>
#include <unistd.h>

namespace quoin::runtime {

namespace {
constexpr std::uint64_t worth_it = 128U << 10U;  // [byte]

// [byte] The C library's own, which it raises to what has ever been allocated and freed at once.
constexpr int threshold = 128 << 10;
}  // namespace

std::uint64_t resident_memory() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0;
  std::uint64_t resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

MemoryTrim::MemoryTrim(Clock::duration period) : period_(period), next_(Clock::now() + period) {
  ::mallopt(M_MMAP_THRESHOLD, threshold);
  ::mallopt(M_TRIM_THRESHOLD, threshold);
}

void MemoryTrim::tick() {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + period_;
  if (resident_memory() < trimmed_to_ + worth_it) return;
  ::malloc_trim(0);
  trimmed_to_ = resident_memory();
}

}  // namespace quoin::runtime
