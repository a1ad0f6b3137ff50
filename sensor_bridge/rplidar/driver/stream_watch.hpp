// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "sensor_bridge/rplidar/driver/diagnosis.hpp"
#include "sensor_bridge/rplidar/driver/driver_settings.hpp"
#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Detects when a stream of measurements is not worth reading on.
class StreamWatch {
 public:
  StreamWatch(const TimeOuts& time_outs, TimePoint start);

  /// After each reading, also of nothing: what is wrong by now. `bytes` since the start.
  [[nodiscard]] std::optional<Finding> judge(TimePoint now, const DecoderCounts& counts,
                                             std::uint64_t bytes);
  void note_revolution(TimePoint now) { last_revolution_ = now; }

  /// Measurements have come for long enough to forget what was wrong before.
  [[nodiscard]] bool stable(TimePoint now) const;

 private:
  struct Mark {
    TimePoint time;
    std::uint64_t frames = 0;
    std::uint64_t bytes = 0;
    std::uint64_t skipped_bytes = 0;
    std::uint64_t checksum_errors = 0;
    std::uint64_t out_of_line = 0;
  };

  [[nodiscard]] std::optional<Finding> judge_window(const Mark& now);

  TimeOuts time_outs_;
  Mark last_frame_;
  Mark window_;
  std::optional<TimePoint> first_frame_;
  std::optional<TimePoint> last_revolution_;
};

/// Detects when the motor does not turn at the speed that was set.
class RotationWatch {
 public:
  static constexpr double tolerance = 0.1;

  /// `speed` [rev/min]; nothing is reported of a motor whose speed was not set.
  RotationWatch(std::optional<std::uint16_t> speed, TimePoint spun_up)
      : speed_(speed.value_or(0)), spun_up_(spun_up) {}

  /// The measured speed when a few revolutions in a row begin to be off by more than the tolerance,
  /// once. Those before `spun_up` do not count, unless it has been right before.
  [[nodiscard]] std::optional<double> note(const Revolution& revolution);

 private:
  static constexpr int enough = 3;

  double speed_;
  TimePoint spun_up_;
  bool was_right_ = false;
  int wrong_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
