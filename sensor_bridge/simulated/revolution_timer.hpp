// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
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
  RevolutionTimer(TimePoint start, double rate) : start_(start), period_(1.0 / rate) {}

  /// The revolution after the last one given, unless it ended more than a period before `now`: then
  /// the current one, so that a sensor that was late continues in time and sends no burst.
  [[nodiscard]] Revolution next(TimePoint now) {
    if (now > boundary(index_ + 2)) {
      index_ = static_cast<std::int64_t>(std::floor(Seconds(now - start_).count() / period_));
    }
    const Revolution revolution{boundary(index_), boundary(index_ + 1)};
    ++index_;
    return revolution;
  }

 private:
  using Seconds = std::chrono::duration<double>;

  [[nodiscard]] TimePoint boundary(std::int64_t index) const {
    return start_ +
           std::chrono::round<TimePoint::duration>(Seconds(static_cast<double>(index) * period_));
  }

  TimePoint start_;
  double period_;  // [s]
  std::int64_t index_ = 0;
};

}  // namespace quoin::sensor_bridge
