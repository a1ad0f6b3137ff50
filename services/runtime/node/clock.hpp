// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace quoin::runtime {

/// Wall clock [ns since the Unix epoch], as all stamps in messages.
[[nodiscard]] inline std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// [ns since the Unix epoch] of a time of the steady clock, by the wall clock as it is now.
[[nodiscard]] inline std::int64_t epoch_ns(std::chrono::steady_clock::time_point time) {
  return now_ns() - std::chrono::nanoseconds(std::chrono::steady_clock::now() - time).count();
}

}  // namespace quoin::runtime
