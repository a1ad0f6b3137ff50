// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

/// When each scan of a recording is due. The time between two scans is the difference of their
/// stamps as long as that is positive and at most `longest_period`; recordings hold stamps that
/// stand still, jump back, overflow or leave out a night. There the last good period is used again.
class Playback {
 public:
  static constexpr double longest_period = 10.0;    ///< [s] of recorded time
  static constexpr double longest_pause = 86400.0;  ///< [s] a longer one is a wrong stamp

  /// `speed`: factor on the recorded speed; 0 is without waiting. `rate` [Hz] for scans without
  /// usable stamps before.
  Playback(double speed, double rate);

  /// When the next scan, `scan`, is due: a time [s] on the caller's clock, which shows `now`. The
  /// first is due at once. Times add up without drift; a player that is late by more than a
  /// period continues from `now` and sends no burst.
  [[nodiscard]] double due(const RecordedScan& scan, double now);

  /// The same for a message that was recorded at `time` [s], by a clock that does not jump: of the
  /// time to the message before, what is beyond `longest_period` is left out.
  [[nodiscard]] double due_at(double time, double now);

  /// From now on. Returns when what was due at `due` is due by that speed, and is not before `now`.
  double set_speed(double speed, double now);
  [[nodiscard]] double speed() const { return speed_; }

  /// Recorded time [s] from the first scan to the one that `due` was asked for last, with pauses of
  /// up to a day as they are, and the last good period where a stamp cannot be used.
  [[nodiscard]] double recorded_time() const { return recorded_time_; }

  /// Scans whose stamp could not be used although there is one.
  [[nodiscard]] std::size_t bad_stamps() const { return bad_stamps_; }

 private:
  double due_after(double seconds, double longest_delay, double now);

  double speed_;
  double period_;  // [s] last good one
  double due_ = 0.0;
  double recorded_time_ = 0.0;
  bool first_ = true;
  std::optional<double> last_stamp_;
  std::size_t bad_stamps_ = 0;
};

}  // namespace quoin::sensor_bridge
