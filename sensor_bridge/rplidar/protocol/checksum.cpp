// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/checksum.hpp"

#include <cstddef>

#include <zlib.h>

namespace quoin::sensor_bridge::rplidar {

std::uint8_t xor_checksum(std::span<const std::uint8_t> bytes) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum = static_cast<std::uint8_t>(sum ^ byte);
  return sum;
}

std::uint32_t padded_crc32(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t zeros[4] = {};
  uLong crc = crc32(0, bytes.data(), static_cast<uInt>(bytes.size()));
  crc = crc32(crc, zeros, static_cast<uInt>(4 - bytes.size() % 4));
  return static_cast<std::uint32_t>(crc);
}

}  // namespace quoin::sensor_bridge::rplidar
