// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/stopwatch.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace quoin {

double seconds_per_call(const std::function<void()>& function, double run_time) {
  using Clock = std::chrono::steady_clock;
  constexpr int runs = 5;
  const auto time = [&function](long calls) {
    const auto start = Clock::now();
    for (long i = 0; i < calls; ++i) function();
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  long calls = 1;
  while (time(calls) < run_time) calls *= 2;
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    best = std::min(best, time(calls) / static_cast<double>(calls));
  }
  return best;
}

}  // namespace quoin
