// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/heartbeat.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/services/runtime/heap.hpp"

namespace quoin::runtime {
namespace {

constexpr std::size_t block = 1000;      // [byte] small enough to be taken from the heap
constexpr std::size_t burst = 64 << 20;  // [byte]

using Blocks = std::vector<std::unique_ptr<std::vector<char>>>;

/// Frees all that a burst has needed but for the last block, which keeps the heap from being cut
/// off at its end.
[[nodiscard]] Blocks after_a_burst() {
  Blocks blocks(burst / block);
  for (auto& memory : blocks) memory = std::make_unique<std::vector<char>>(block, 'x');
  std::fill(blocks.begin(), blocks.end() - 1, nullptr);
  return blocks;
}

TEST(Memory, WhatABurstHasNeededIsGivenBack) {
  if (!tests::heap_is_visible())
    GTEST_SKIP() << "this process has another heap than that of the C library";
  MemoryTrim trim(std::chrono::seconds(0));
  trim.tick();
  const auto before = resident_memory();
  const Blocks blocks = after_a_burst();
  ASSERT_GT(resident_memory(), before + burst / 2);
  trim.tick();
  EXPECT_LT(resident_memory(), before + burst / 8);
}

TEST(Memory, NothingIsDoneBeforeItsTime) {
  MemoryTrim trim(std::chrono::hours(1));
  const Blocks blocks = after_a_burst();
  const auto before = resident_memory();
  trim.tick();
  EXPECT_GT(resident_memory() + burst / 8, before);
}

}  // namespace
}  // namespace quoin::runtime
