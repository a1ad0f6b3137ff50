// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Exclusive or of all bytes.
[[nodiscard]] std::uint8_t xor_checksum(std::span<const std::uint8_t> bytes);

/// The same over a number of bytes that the compiler knows, by words of eight.
template <std::size_t size>
[[nodiscard]] inline std::uint8_t xor_checksum(const std::uint8_t* bytes) {
  std::uint64_t sum = 0;
  std::size_t i = 0;
  for (; i + 8 <= size; i += 8) sum ^= load<std::uint64_t>(bytes + i);
  for (; i < size; ++i) sum ^= bytes[i];
  sum ^= sum >> 32;
  sum ^= sum >> 16;
  sum ^= sum >> 8;
  return static_cast<std::uint8_t>(sum);
}

/// CRC-32 of zlib over the bytes and the zeros that HQ capsules reckon behind them: up to the next
/// multiple of four, and four of them where there is none to fill up.
[[nodiscard]] std::uint32_t padded_crc32(std::span<const std::uint8_t> bytes);

}  // namespace quoin::sensor_bridge::rplidar
