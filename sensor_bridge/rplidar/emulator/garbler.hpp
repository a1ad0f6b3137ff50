// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace quoin::sensor_bridge::rplidar {

/// Stands for what a receiver makes of bytes that were sent at another baud rate: other bytes,
/// which depend on all that came before, the same for the same input.
class Garbler {
 public:
  void garble(std::span<std::uint8_t> bytes) {
    for (std::uint8_t& byte : bytes) {
      state_ = (state_ ^ byte) * 0x9E3779B97F4A7C15U + 0xD1B54A32D192ED03U;
      byte = static_cast<std::uint8_t>(state_ >> 56U);
    }
  }

 private:
  std::uint64_t state_ = 1;
};

}  // namespace quoin::sensor_bridge::rplidar
