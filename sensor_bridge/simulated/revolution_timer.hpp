// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace quoin::sensor_bridge {

/// When each revolution of a sensor that never stops turning begins and ends. All times are
/// multiples of the period after the start, so that no error adds up; the clock itself is the
/// caller's.
class RevolutionTimer {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  struct Revolution {
    TimePoint begin;  ///< acquisition of the first ray
    TimePoint end;    ///< the scan is complete
  };

  /// `rate` in Hz, positive.
  RevolutionTimer(TimePoint start, double rate);

  /// The revolution after the last one given, unless it ended more than a period before `now`: then
  /// the one that is under way, so that a sensor that was held up goes on in time and sends no
  /// burst.
  [[nodiscard]] Revolution next(TimePoint now);

 private:
  [[nodiscard]] TimePoint boundary(std::int64_t index) const;

  TimePoint start_;
  double period_;  // [s]
  std::int64_t index_ = 0;
};

}  // namespace quoin::sensor_bridge
