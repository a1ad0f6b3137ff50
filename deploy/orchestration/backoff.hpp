// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace quoin::deploy {

/// How long to wait before a process that died is started again: doubling from 0.2 s to 10 s, from
/// the beginning again once a process has lived for 10 s.
class Backoff {
 public:
  using Duration = std::chrono::milliseconds;

  /// Pause after a process that lived for `lifetime`.
  [[nodiscard]] Duration next(std::chrono::nanoseconds lifetime) {
    if (lifetime >= longest) pause_ = shortest;
    const Duration pause = pause_;
    pause_ = std::min(2 * pause_, longest);
    return pause;
  }

 private:
  static constexpr Duration shortest{200};
  static constexpr Duration longest{10'000};
  Duration pause_ = shortest;
};

}  // namespace quoin::deploy
