// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Streams in which whole frames or single bytes are missing.

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"
#include "tests/sensor_bridge/rplidar/protocol/sample_stream.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

double degrees(const DecodedSample& sample) { return sample.angle_q16 / 65536.0; }

/// An S1 turns by 1002/64 degrees in each capsule.
constexpr unsigned step_q6 = 1002;

Bytes capsule_number(unsigned number) {
  return dense_capsule(number * step_q6 % (360 * 64), 4000 + number, number == 0);
}

TEST(LostFrames, TheCapsuleBeforeALostOneEndsWhereItDid) {
  // 0, 15.66 and 46.95 degrees; the capsule at 31.30 is missing.
  const DecodedSamples samples =
      decode(SampleFormat::dense,
             dense_capsule(0, 4000, true) + dense_capsule(1002, 4001) + dense_capsule(3005, 4003));
  ASSERT_EQ(samples.size(), 80u);
  EXPECT_NEAR(degrees(samples[40]), 15.66, 0.01);
  EXPECT_NEAR(degrees(samples[79]), 30.91, 0.01);  // and not 46.17
}

TEST(LostFrames, TheSamplesOfTheLostCapsuleAreCounted) {
  SampleDecoder decoder(SampleFormat::dense);
  std::size_t lost = 0;
  std::size_t gaps = 0;
  SampleBlock block;
  for (const unsigned number : {0, 1, 2, 3, 4, 6, 7, 8, 11, 12, 13, 13, 14, 16, 15, 17, 18}) {
    const Bytes bytes = capsule_number(number);
    std::span<const std::uint8_t> rest(bytes);
    if (!decoder.next(rest, block)) continue;
    lost += block.lost;
    if (block.after_gap) ++gaps;
    const double number_read = block.distance_q2[0] / 4.0 - 4000.0;
    for (std::size_t k = 0; k < block.size; ++k) {
      const double turned = (number_read + static_cast<double>(k) / 40.0) * step_q6 / 64.0;
      ASSERT_NEAR(block.angle_q16[k] / 65536.0, std::fmod(turned, 360.0), 0.01) << number_read;
    }
  }
  EXPECT_EQ(lost, 3u * 40u);                       // 5, 9 and 10
  EXPECT_EQ(gaps, 3u);                             // with the begin; 15 and 16 are put right
  EXPECT_EQ(decoder.counts().samples, 15u * 40u);  // 18 waits
  EXPECT_EQ(decoder.counts().repeated, 1u);
}

TEST(LostFrames, ACapsuleThatFitsNothingIsDropped) {
  SampleDecoder decoder(SampleFormat::dense);
  Bytes bytes;
  for (unsigned number = 0; number < 6; ++number) bytes = bytes + capsule_number(number);
  bytes = bytes + dense_capsule(200 * 64, 1234);
  for (unsigned number = 7; number < 12; ++number) bytes = bytes + capsule_number(number);
  const DecodedSamples samples = decode(decoder, bytes);
  EXPECT_EQ(samples.size(), 10u * 40u);
  for (const DecodedSample& sample : samples) EXPECT_NE(sample.distance_q2, 4u * 1234u);
  EXPECT_GE(decoder.counts().out_of_line, 1u);
}

/// A device with 197 standard nodes in a turn, which marks the first one behind zero.
Bytes turning_nodes(unsigned count) {
  Bytes bytes;
  unsigned angle = 300 * 64;
  for (unsigned i = 0; i < count; ++i) {
    const unsigned next = (angle + 117) % (360 * 64);
    const bool first = angle < 117 && i > 0;
    const unsigned distance = 4000 + i * 37 % 1500;
    for (const unsigned byte : {0x50u | (first ? 1u : 2u), (angle << 1 | 1) & 0xFF, angle >> 7,
                                distance & 0xFF, distance >> 8}) {
      bytes.push_back(static_cast<std::uint8_t>(byte));
    }
    angle = next;
  }
  return bytes;
}

TEST(LostFrames, ALostByteCostsAFewNodesAndNoRevolution) {
  constexpr double period = 0.1 / 197;
  const Bytes good = turning_nodes(6 * 197);
  std::size_t fewest = 197;
  for (std::size_t place = 3 * 5 * 197 / 2; place < 3 * 5 * 197 / 2 + 5 * 197; ++place) {
    Bytes bytes = good;
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(place));
    SampleDecoder decoder(SampleFormat::standard);
    RevolutionAssembler assembler(period, 0.0);
    SampleBlock block;
    Revolution revolution;
    std::size_t revolutions = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 10) {
      std::span<const std::uint8_t> rest =
          std::span(bytes).subspan(at, std::min<std::size_t>(10, bytes.size() - at));
      const auto arrival = TimePoint() + std::chrono::hours(1) +
                           std::chrono::nanoseconds(std::llround(at / 5.0 * period * 1e9));
      while (decoder.next(rest, block)) {
        if (!assembler.add(block, arrival, revolution)) continue;
        ++revolutions;
        fewest = std::min(fewest, revolution.angle_q16.size());
        ASSERT_LE(revolution.angle_q16.size(), 198u) << place;
        ASSERT_LE(revolution.angle_q16.size() + revolution.lost, 198u) << place;
      }
    }
    ASSERT_EQ(revolutions, 5u) << place;
    ASSERT_LE(assembler.lost_samples(), 6u) << place;
  }
  EXPECT_GE(fewest, 197u - 6u);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
