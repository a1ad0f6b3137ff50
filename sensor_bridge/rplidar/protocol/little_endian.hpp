// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace quoin::sensor_bridge::rplidar {

/// The number that begins at `bytes`, least significant byte first, wherever it lies.
template <std::unsigned_integral T>
[[nodiscard]] inline T load(const std::uint8_t* bytes) {
  T value;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&value, bytes, sizeof(T));
  } else {
    value = 0;
    for (std::size_t i = sizeof(T); i > 0; --i) {
      value = static_cast<T>((value << 8) | bytes[i - 1]);
    }
  }
  return value;
}

template <std::unsigned_integral T>
inline void store(std::uint8_t* bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

}  // namespace quoin::sensor_bridge::rplidar
