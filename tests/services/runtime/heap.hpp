// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <malloc.h>
#include <vector>

namespace quoin::tests {

/// [byte] What this process has allocated from the heap and not given back.
inline std::size_t heap_in_use() {
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Whether heap_in_use() sees allocations: a sanitizer has a heap of its own.
inline bool heap_is_visible() {
  const std::size_t before = heap_in_use();
  const std::vector<char> memory(1U << 20U);
  return heap_in_use() >= before + memory.size();
}

}  // namespace quoin::tests
