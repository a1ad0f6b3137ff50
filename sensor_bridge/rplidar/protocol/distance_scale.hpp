// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace quoin::sensor_bridge::rplidar {

/// How ultra capsules shorten distances: steps that grow with the distance.
struct UltraDistance {
  std::uint32_t distance = 0;  ///< [mm]
  unsigned level = 0;          ///< steps of 2^level mm
};

/// `code` of 12 bits.
[[nodiscard]] UltraDistance decode_ultra_distance(std::uint32_t code);
/// The code of the nearest distance that has one; 0, no return, for what is too far.
[[nodiscard]] std::uint32_t encode_ultra_distance(std::uint32_t distance_q2);

/// What an ultra-dense capsule says of one point.
struct UltraDensePoint {
  std::uint32_t distance_q2 = 0;  ///< [1/4 mm]
  std::uint8_t quality = 0;
  bool fine = false;  ///< on the finest of the four scales, which readers smooth
};

/// `word` of 20 bits: two of scale, then distance and quality, which share the rest.
[[nodiscard]] UltraDensePoint decode_ultra_dense_point(std::uint32_t word);
/// The word of the nearest distance that has one; 0, no return, for what is too far.
[[nodiscard]] std::uint32_t encode_ultra_dense_point(std::uint32_t distance_q2,
                                                     std::uint8_t quality);

}  // namespace quoin::sensor_bridge::rplidar
