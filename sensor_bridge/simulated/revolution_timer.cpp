// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/revolution_timer.hpp"

#include <cmath>

namespace quoin::sensor_bridge {

using Seconds = std::chrono::duration<double>;

RevolutionTimer::RevolutionTimer(TimePoint start, double rate)
    : start_(start), period_(1.0 / rate) {}

RevolutionTimer::Revolution RevolutionTimer::next(TimePoint now) {
  if (now > boundary(index_ + 2)) {
    index_ = static_cast<std::int64_t>(std::floor(Seconds(now - start_).count() / period_));
  }
  const Revolution revolution{boundary(index_), boundary(index_ + 1)};
  ++index_;
  return revolution;
}

RevolutionTimer::TimePoint RevolutionTimer::boundary(std::int64_t index) const {
  return start_ +
         std::chrono::round<TimePoint::duration>(Seconds(static_cast<double>(index) * period_));
}

}  // namespace quoin::sensor_bridge
