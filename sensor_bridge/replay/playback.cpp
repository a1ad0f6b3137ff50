// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/playback.hpp"

#include <algorithm>

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
  return due_after(period_, 0.0, now);
}

double Playback::due_at(double time, double now) {
  // Messages of one scan follow each other at once: to be late by so little is nothing.
  constexpr double shortest_delay = 0.1;  // [s]
  const double gap = std::max(time - last_stamp_.value_or(time), 0.0);
  last_stamp_ = time;
  if (!first_) recorded_time_ += gap;
  return due_after(std::min(gap, longest_period), shortest_delay, now);
}

/// `longest_delay` [s]: a player may be late by a period, or by that if it is longer.
double Playback::due_after(double seconds, double longest_delay, double now) {
  const double wait = speed_ > 0.0 ? seconds / speed_ : 0.0;
  due_ += wait;
  if (first_ || now > due_ + std::max(wait, longest_delay)) due_ = now;
  first_ = false;
  return due_;
}

double Playback::set_speed(double speed, double now) {
  const double left = std::max(due_ - now, 0.0) * speed_;  // [s] of recorded time
  speed_ = speed;
  due_ = now + (speed > 0.0 ? left / speed : 0.0);
  return due_;
}

}  // namespace quoin::sensor_bridge
