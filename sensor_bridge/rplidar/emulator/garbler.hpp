// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quoin::sensor_bridge::rplidar {

/// Turns bytes into other ones, which depend on all that came before, the same for the same input.
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

/// What a receiver reads at its baud rate of bytes that were sent at another one, one right behind
/// the other with 8 data bits, no parity and a stop bit: at each falling edge it begins a byte, and
/// takes the level in the middle of each of its bits.
[[nodiscard]] inline std::vector<std::uint8_t> read_at_other_rate(
    std::span<const std::uint8_t> bytes, double sent_rate, double read_rate) {
  const auto bits = static_cast<double>(10 * bytes.size());
  const auto level = [&](double time) {  // [bit of the sender]; the line idles high
    if (time >= bits) return true;
    const auto bit = static_cast<std::size_t>(time);
    if (bit % 10 == 0) return false;
    if (bit % 10 == 9) return true;
    return (bytes[bit / 10] >> (bit % 10 - 1) & 1) != 0;
  };
  const double step = sent_rate / read_rate;
  std::vector<std::uint8_t> read;
  for (double time = 0.0; time < bits;) {
    if (level(time)) {
      time = std::floor(time) + 1.0;
      continue;
    }
    unsigned byte = 0;
    for (unsigned bit = 0; bit < 8; ++bit) {
      byte |= static_cast<unsigned>(level(time + (1.5 + bit) * step)) << bit;
    }
    read.push_back(static_cast<std::uint8_t>(byte));
    time += 9.5 * step;  // in the middle of the stop bit
    // Behind a stop bit that was none, the line has to rise before the next byte.
    while (time < bits && !level(time)) time = std::floor(time) + 1.0;
  }
  return read;
}

}  // namespace quoin::sensor_bridge::rplidar
