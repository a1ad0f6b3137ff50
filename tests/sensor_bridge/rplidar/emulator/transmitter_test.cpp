// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/transmitter.hpp"

#include <gmock/gmock.h>

#include "sensor_bridge/rplidar/emulator/seconds.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

constexpr Transmitter::TimePoint start{std::chrono::hours(1)};

Transmitter::TimePoint after(double seconds) { return start + duration_of(seconds); }

Bytes popped(Transmitter& transmitter, double seconds) {
  Bytes bytes;
  transmitter.pop(after(seconds), bytes);
  return bytes;
}

TEST(Transmitter, TakesTenBitsAByte) {
  Transmitter transmitter(10000);  // 1 ms a byte
  EXPECT_EQ(transmitter.next(), std::nullopt);
  transmitter.push(Bytes{1, 2, 3}, start);
  transmitter.push(Bytes{4}, after(0.001));
  EXPECT_EQ(transmitter.next(), after(0.003));
  EXPECT_THAT(popped(transmitter, 0.0029), IsEmpty());
  EXPECT_THAT(popped(transmitter, 0.003), ElementsAre(1, 2, 3));
  EXPECT_THAT(popped(transmitter, 0.003), IsEmpty());
  EXPECT_THAT(popped(transmitter, 0.004), ElementsAre(4));
  transmitter.push(Bytes{5}, after(1.0));  // after a rest
  EXPECT_EQ(transmitter.next(), after(1.001));
  EXPECT_THAT(popped(transmitter, 2.0), ElementsAre(5));
}

TEST(Transmitter, LosesWhatIsTooMuch) {
  Transmitter transmitter(10000);
  const Bytes half(Transmitter::capacity / 2, 7);
  transmitter.push(half, start);
  transmitter.push(half, start);
  transmitter.push(Bytes{1, 2}, start);
  EXPECT_EQ(transmitter.lost_bytes(), 2U);
  // What has left makes room, whether it was fetched or not.
  transmitter.push(Bytes{3}, after(2.1));
  EXPECT_EQ(transmitter.lost_bytes(), 2U);
  const Bytes all = popped(transmitter, 10.0);
  EXPECT_EQ(all.size(), Transmitter::capacity + 1);
  EXPECT_EQ(all.back(), 3);
}

TEST(Transmitter, KeepsTheOrderForLong) {
  Transmitter transmitter(1'000'000);
  std::uint8_t given = 0;
  std::uint8_t expected = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes piece(7);
    for (std::uint8_t& byte : piece) byte = given++;
    transmitter.push(piece, after(i * 1e-4));
    for (const std::uint8_t byte : popped(transmitter, i * 1e-4)) ASSERT_EQ(byte, expected++);
  }
  EXPECT_EQ(transmitter.lost_bytes(), 0U);
}

TEST(Transmitter, ForgetsWhenTold) {
  Transmitter transmitter(10000);
  transmitter.push(Bytes{1, 2, 3}, start);
  transmitter.clear();
  EXPECT_THAT(popped(transmitter, 1.0), IsEmpty());
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
