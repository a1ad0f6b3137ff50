// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/distance_scale.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

namespace quoin::sensor_bridge::rplidar {
namespace {

std::int64_t difference(std::uint32_t left, std::uint32_t right) {
  return std::abs(std::int64_t{left} - std::int64_t{right});
}

// The first code of each level and the last one before it.
TEST(UltraDistance, IsThatOfTheTable) {
  const struct {
    std::uint32_t code;
    std::uint32_t distance;
    unsigned level;
  } table[] = {{0, 0, 0},        {511, 511, 0},   {512, 512, 1},   {1279, 2046, 1},
               {1280, 2048, 2},  {1791, 4092, 2}, {1792, 4096, 3}, {3327, 16376, 3},
               {3328, 16384, 4}, {4095, 28656, 4}};
  for (const auto& row : table) {
    EXPECT_EQ(decode_ultra_distance(row.code).distance, row.distance);
    EXPECT_EQ(decode_ultra_distance(row.code).level, row.level);
    EXPECT_EQ(encode_ultra_distance(4 * row.distance), row.code);
  }
}

TEST(UltraDistance, IsRoundedToItsSteps) {
  for (std::uint32_t distance_q2 = 0; distance_q2 <= 4 * 28656; ++distance_q2) {
    const UltraDistance read = decode_ultra_distance(encode_ultra_distance(distance_q2));
    ASSERT_LE(difference(4 * read.distance, distance_q2), 2 + (2 << read.level)) << distance_q2;
  }
  EXPECT_EQ(encode_ultra_distance(4 * 28700), 0u);
  EXPECT_EQ(encode_ultra_distance(0xFFFFFFFF), 0u);
}

TEST(UltraDensePoint, IsRoundedToItsSteps) {
  for (std::uint32_t distance_q2 = 0; distance_q2 <= 262088; ++distance_q2) {
    const std::uint32_t word = encode_ultra_dense_point(distance_q2, 0xF8);
    ASSERT_LT(word, 1u << 20);
    const UltraDensePoint read = decode_ultra_dense_point(word);
    const std::int64_t step_q2 = distance_q2 < 8184    ? 8
                                 : distance_q2 < 32748 ? 12
                                 : distance_q2 < 98268 ? 16
                                                       : 20;
    ASSERT_LE(difference(read.distance_q2, distance_q2), step_q2 / 2) << distance_q2;
    ASSERT_EQ(read.quality, 0xF8) << distance_q2;
    ASSERT_EQ(read.fine, distance_q2 < 8184) << distance_q2;
  }
  EXPECT_EQ(encode_ultra_dense_point(262200, 0xFF), 0u);
  EXPECT_EQ(encode_ultra_dense_point(0xFFFFFFFF, 0xFF), 0u);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
