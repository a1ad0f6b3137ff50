// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "sensor_bridge/rplidar/protocol/sample_block.hpp"

namespace quoin::sensor_bridge::rplidar {

inline std::chrono::nanoseconds seconds(double value) {
  return std::chrono::nanoseconds(std::llround(value * 1e9));
}

/// A sensor that sends dense capsules and knows when it measured what: sample i at
/// i * sample_period, at `begin_angle` + i * 360 / samples_per_revolution degrees, with i as its
/// distance.
struct RevolvingSensor {
  static constexpr std::size_t block_samples = 40;

  double sample_period = 108e-6;  ///< [s]
  double samples_per_revolution = 926.0;
  double begin_angle = 0.0;  ///< [deg]
  std::size_t sent = 0;
  bool gap = true;
  std::size_t lost = 0;

  [[nodiscard]] SampleBlock next() {
    SampleBlock block;
    block.size = block_samples;
    block.age = 2 * block_samples - 1;
    block.after_gap = gap;
    block.lost = std::exchange(lost, 0);
    block.lost_known = true;
    block.samples_per_turn = samples_per_revolution;
    gap = false;
    for (std::size_t k = 0; k < block.size; ++k, ++sent) {
      const double angle = std::fmod(
          begin_angle + static_cast<double>(sent) * 360.0 / samples_per_revolution, 360.0);
      block.angle_q16[k] = static_cast<std::uint32_t>(angle * 65536.0);
      block.distance_q2[k] = static_cast<std::uint32_t>(sent);
      block.quality[k] = 188;
    }
    return block;
  }

  void lose_block() {
    sent += block_samples;
    lost += block_samples;
    gap = true;
  }

  [[nodiscard]] TimePoint time_of(std::size_t sample) const {
    return TimePoint{} + seconds(static_cast<double>(sample) * sample_period);
  }

  /// When the last block given out can be read, if nothing holds it up.
  [[nodiscard]] TimePoint arrival(double delay) const {
    return time_of(sent + block_samples - 1) + seconds(delay);
  }
};

}  // namespace quoin::sensor_bridge::rplidar
