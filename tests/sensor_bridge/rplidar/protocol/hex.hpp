// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quoin::sensor_bridge::rplidar {

using Bytes = std::vector<std::uint8_t>;

/// "A5 25" as two bytes.
inline Bytes hex(std::string_view text) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 3) {
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoul(std::string(text.substr(i, 2)), nullptr, 16)));
  }
  return bytes;
}

/// The same several times over.
inline Bytes hex(std::string_view text, std::size_t times) {
  const Bytes once = hex(text);
  Bytes bytes;
  for (std::size_t i = 0; i < times; ++i) bytes.insert(bytes.end(), once.begin(), once.end());
  return bytes;
}

inline Bytes operator+(Bytes left, std::span<const std::uint8_t> right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

inline Bytes to_bytes(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace quoin::sensor_bridge::rplidar
