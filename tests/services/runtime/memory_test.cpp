// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/memory.hpp"

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

TEST(Memory, WhatABurstHasNeededIsGivenBack) {
  if (!tests::heap_is_visible())
    GTEST_SKIP() << "this process has another heap than that of the C library";
  MemoryTrim trim(std::chrono::seconds(0));
  trim.tick();
  const auto before = resident_memory();
  std::vector<std::unique_ptr<std::vector<char>>> blocks(burst / block);
  for (auto& memory : blocks) memory = std::make_unique<std::vector<char>>(block, 'x');
  // The last one keeps the heap from being cut off at its end.
  std::fill(blocks.begin(), blocks.end() - 1, nullptr);
  ASSERT_GT(resident_memory(), before + burst / 2);
  trim.tick();
  EXPECT_LT(resident_memory(), before + burst / 8);
}

TEST(Memory, NothingIsDoneBeforeItsTime) {
  MemoryTrim trim(std::chrono::hours(1));
  std::vector<std::unique_ptr<std::vector<char>>> blocks(burst / block);
  for (auto& memory : blocks) memory = std::make_unique<std::vector<char>>(block, 'x');
  std::fill(blocks.begin(), blocks.end() - 1, nullptr);
  const auto before = resident_memory();
  trim.tick();
  EXPECT_GT(resident_memory() + burst / 8, before);
}

}  // namespace
}  // namespace quoin::runtime
