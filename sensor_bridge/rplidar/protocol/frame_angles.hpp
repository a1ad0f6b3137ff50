// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "sensor_bridge/rplidar/protocol/sample_block.hpp"

namespace quoin::sensor_bridge::rplidar {

/// No RPLIDAR turns at other speeds [rev/s], with 2 % for what its control leaves.
inline constexpr double slowest_rotation = 0.98;
inline constexpr double fastest_rotation = 20.4;

/// From one angle clockwise to the other, 0 up to below a circle.
[[nodiscard]] constexpr std::int32_t clockwise_q16(std::int32_t from_q16, std::int32_t to_q16) {
  const std::int32_t turn = to_q16 - from_q16;
  return turn < 0 ? turn + static_cast<std::int32_t>(full_circle_q16) : turn;
}

/// The same within half a circle to either side.
[[nodiscard]] constexpr std::int32_t turned_q16(std::int32_t from_q16, std::int32_t to_q16) {
  const std::int32_t turn = clockwise_q16(from_q16, to_q16);
  return turn > static_cast<std::int32_t>(full_circle_q16 / 2)
             ? turn - static_cast<std::int32_t>(full_circle_q16)
             : turn;
}

/// Where the frames of a sensor that turns evenly begin. Nothing numbers frames on the wire, but a
/// motor cannot change its speed by half from one frame to the next: the angle at which a frame
/// begins shows whether frames are missing before it.
class FrameAngles {
 public:
  /// [1/65536 deg] that the sensor turns in a frame; 0 while it is not known.
  [[nodiscard]] std::int32_t step_q16() const { return step_q16_; }
  /// Two steps in a row have agreed.
  [[nodiscard]] bool confirmed() const { return confirmed_; }

  /// Whether a frame that begins `difference_q16` behind another can be the next one.
  [[nodiscard]] bool can_follow(std::int32_t difference_q16) const {
    constexpr std::int32_t half_circle = full_circle_q16 / 2;
    constexpr std::int32_t resolution = 1 << 13;  // of slow motors: 1/8 degree
    if (difference_q16 > half_circle) return false;
    if (step_q16_ == 0) return true;
    if (difference_q16 > step_q16_ + step_q16_ / 2 + resolution) return false;
    return difference_q16 >= step_q16_ - step_q16_ / 3 - resolution;
  }

  void note_step(std::int32_t step_q16) {
    confirmed_ = step_q16_ != 0;
    step_q16_ = step_q16;
  }
  void forget() {
    step_q16_ = 0;
    confirmed_ = false;
  }

  /// How many frames are missing where a frame was expected at one angle and begins at the other;
  /// nothing when no whole number of frames fits, or each would.
  [[nodiscard]] std::optional<int> missing_frames(std::int32_t expected_q16,
                                                  std::int32_t begin_q16) const {
    constexpr auto circle = static_cast<std::int32_t>(full_circle_q16);
    constexpr std::int32_t standing = (1 << 16) / 10;
    if (step_q16_ < standing || step_q16_ > circle / 3) return std::nullopt;
    const std::int32_t tolerance = step_q16_ / 4 + (1 << 11);
    const std::int32_t ahead = clockwise_q16(expected_q16, begin_q16);
    if (ahead >= circle - tolerance) return 0;
    const std::int32_t frames = (ahead + step_q16_ / 2) / step_q16_;
    const std::int32_t rest = ahead - frames * step_q16_;
    // What the speed may differ by adds up.
    const std::int32_t allowed = tolerance + frames * (step_q16_ / 64);
    return rest <= allowed && rest >= -allowed ? std::optional<int>(frames) : std::nullopt;
  }

 private:
  std::int32_t step_q16_ = 0;
  bool confirmed_ = false;
};

}  // namespace quoin::sensor_bridge::rplidar
