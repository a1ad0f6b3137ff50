// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace quoin::soak {

/// How the resident memory of processes develops, from a time at which they have warmed up.
class Memory {
 public:
  /// From now on it counts.
  void begin();
  /// Takes a sample of each process, when the last one is a second old. A process that has ended
  /// stays ended, whoever gets its number.
  void sample(const std::map<pid_t, std::string>& processes);

  struct Growth {
    std::string service;
    double before = 0.0;  ///< [byte] median of the first ten samples
    double after = 0.0;   ///< [byte] median of the last ten
  };
  /// Of every process that has lived for half a minute since.
  [[nodiscard]] std::vector<Growth> growths() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct History {
    std::string service;
    std::string started;          // in ticks since the host was
    std::vector<double> samples;  // [byte] one a second
  };
  Clock::time_point next_;
  std::map<pid_t, History> histories_;
};

}  // namespace quoin::soak
