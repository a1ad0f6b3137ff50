// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace quoin::sensor_bridge::rplidar {

/// The angle of a motor that speeds up and slows down evenly, exactly at any time.
class Motor {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// At rest at `now`, its angle zero.
  explicit Motor(TimePoint now) : begin_(now) {}

  /// From `now`, not before the last call, speeds up or slows down to `speed` [rev/s] with
  /// `acceleration` [rev/s^2]; an infinite one takes no time.
  void turn_at(double speed, double acceleration, TimePoint now);

  /// [rev] since the motor was made; not for times before the last turn_at.
  [[nodiscard]] double turns(TimePoint time) const;
  [[nodiscard]] double speed(TimePoint time) const;  ///< [rev/s]
  [[nodiscard]] double target() const { return target_; }
  /// When it has the speed that was set.
  [[nodiscard]] TimePoint stable_at() const;

 private:
  TimePoint begin_;  // of the values below
  double turns_ = 0.0;
  double speed_ = 0.0;
  double target_ = 0.0;
  double acceleration_ = 0.0;  // with its sign
  double ramp_ = 0.0;          // [s] from begin_ to the target
};

}  // namespace quoin::sensor_bridge::rplidar
