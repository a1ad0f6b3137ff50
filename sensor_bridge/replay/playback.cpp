// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/playback.hpp"

namespace quoin::sensor_bridge {

Playback::Playback(double speed, double rate) : speed_(speed), period_(1.0 / rate) {}

double Playback::due(const RecordedScan& scan, double now) {
  if (scan.first_of_file) last_stamp_.reset();
  std::optional<double> gap;
  if (scan.stamp && last_stamp_) {
    const double period = *scan.stamp - *last_stamp_;
    if (period > 0.0 && period <= longest_pause) gap = period;
    if (gap && period <= longest_period) {
      period_ = period;
    } else {
      ++bad_stamps_;
    }
  }
  last_stamp_ = scan.stamp;
  if (!first_) recorded_time_ += gap.value_or(period_);
  const double wait = speed_ > 0.0 ? period_ / speed_ : 0.0;
  due_ += wait;
  if (first_ || now > due_ + wait) due_ = now;
  first_ = false;
  return due_;
}

}  // namespace quoin::sensor_bridge
