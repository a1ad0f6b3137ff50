// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/distance_scale.hpp"

#include <iterator>

namespace quoin::sensor_bridge::rplidar {
namespace {

struct UltraStep {
  std::uint32_t first_code;
  std::uint32_t first_distance;  ///< [mm]
};

/// Index: level.
constexpr UltraStep ultra_steps[] = {{0, 0}, {512, 512}, {1280, 2048}, {1792, 4096}, {3328, 16384}};
constexpr std::uint32_t largest_code = 0xFFF;

struct UltraDenseScale {
  std::uint32_t factor;             ///< [mm] of one step
  std::uint32_t first_distance_q2;  ///< [1/4 mm]
  std::uint32_t mask;               ///< of the distance in the word; its steps begin at bit 2
  unsigned quality_bit;             ///< where the quality begins
  unsigned quality_shift;           ///< low bits of the quality that are left out
};

/// Index: the two lowest bits of a word.
constexpr UltraDenseScale ultra_dense_scales[] = {{2, 0, 0xFFC, 12, 0},
                                                  {3, 2046 * 4, 0x1FFC, 13, 1},
                                                  {4, 8187 * 4, 0x3FFC, 14, 2},
                                                  {5, 24567 * 4, 0x7FFC, 15, 3}};

}  // namespace

UltraDistance decode_ultra_distance(std::uint32_t code) {
  unsigned level = std::size(ultra_steps) - 1;
  while (code < ultra_steps[level].first_code) --level;
  const UltraStep& step = ultra_steps[level];
  return {step.first_distance + ((code - step.first_code) << level), level};
}

std::uint32_t encode_ultra_distance(std::uint32_t distance_q2) {
  const std::uint32_t distance = (distance_q2 + 2) / 4;
  unsigned level = std::size(ultra_steps) - 1;
  while (distance < ultra_steps[level].first_distance) --level;
  const UltraStep& step = ultra_steps[level];
  const std::uint32_t half_step = level == 0 ? 0 : 1u << (level - 1);
  const std::uint32_t code =
      step.first_code + ((distance - step.first_distance + half_step) >> level);
  return code <= largest_code ? code : 0;
}

UltraDensePoint decode_ultra_dense_point(std::uint32_t word) {
  const UltraDenseScale& scale = ultra_dense_scales[word & 3];
  return {scale.first_distance_q2 + (word & scale.mask) * scale.factor,
          static_cast<std::uint8_t>((word >> scale.quality_bit) << scale.quality_shift),
          (word & 3) == 0};
}

std::uint32_t encode_ultra_dense_point(std::uint32_t distance_q2, std::uint8_t quality) {
  std::uint32_t index = std::size(ultra_dense_scales) - 1;
  while (distance_q2 < ultra_dense_scales[index].first_distance_q2) --index;
  const UltraDenseScale& scale = ultra_dense_scales[index];
  const std::uint32_t step_q2 = 4 * scale.factor;
  const std::uint32_t steps = (distance_q2 - scale.first_distance_q2 + step_q2 / 2) / step_q2;
  if (steps << 2 > scale.mask) return 0;
  return index | steps << 2 | (std::uint32_t{quality} >> scale.quality_shift) << scale.quality_bit;
}

}  // namespace quoin::sensor_bridge::rplidar
