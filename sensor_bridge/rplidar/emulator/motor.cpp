// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/motor.hpp"

#include <algorithm>
#include <cmath>

#include "sensor_bridge/rplidar/emulator/seconds.hpp"

namespace quoin::sensor_bridge::rplidar {

void Motor::turn_at(double speed, double acceleration, TimePoint now) {
  turns_ = turns(now);
  speed_ = this->speed(now);
  begin_ = now;
  target_ = speed;
  ramp_ = std::abs(target_ - speed_) / acceleration;
  acceleration_ = target_ < speed_ ? -acceleration : acceleration;
  if (ramp_ == 0.0) {
    speed_ = target_;
    acceleration_ = 0.0;
  }
}

double Motor::turns(TimePoint time) const {
  const double elapsed = seconds_between(begin_, time);
  const double ramp = std::min(elapsed, ramp_);
  return turns_ + (speed_ + 0.5 * acceleration_ * ramp) * ramp + target_ * (elapsed - ramp);
}

double Motor::speed(TimePoint time) const {
  const double elapsed = seconds_between(begin_, time);
  return elapsed < ramp_ ? speed_ + acceleration_ * elapsed : target_;
}

Motor::TimePoint Motor::stable_at() const { return begin_ + duration_of(ramp_); }

}  // namespace quoin::sensor_bridge::rplidar
