// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/sample_stream.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

/// A smooth wall at 2.1 to 3.9 m with holes, seen by a sensor that turns ten times a second.
std::vector<Sample> wall(std::size_t count) {
  std::vector<Sample> samples(count);
  std::uint32_t angle = 340u << 16;
  for (std::size_t i = 0; i < count; ++i) {
    const auto distance =
        static_cast<std::uint32_t>(12000 + 3600 * std::sin(static_cast<double>(i) / 50.0));
    samples[i] = {angle, i % 30 == 7 ? 0 : distance, 200};
    angle = (angle + full_circle_q16 / 926) % full_circle_q16;
  }
  return samples;
}

/// [1/65536 deg], from -180 degrees up.
std::int32_t turn(std::uint32_t from, std::uint32_t to) {
  const auto difference =
      static_cast<std::int32_t>((to + full_circle_q16 - from) % full_circle_q16);
  constexpr auto circle = static_cast<std::int32_t>(full_circle_q16);
  return difference < circle / 2 ? difference : difference - circle;
}

struct Tolerance {
  SampleFormat format;
  std::int32_t angle_q16;
  int distance_q2;   ///< half a step of the format
  unsigned quality;  ///< as read; 188 where the format has none
};

class RoundTrip : public testing::TestWithParam<Tolerance> {};

TEST_P(RoundTrip, KeepsSamples) {
  const auto [format, angle_tolerance, distance_tolerance, quality] = GetParam();
  const std::size_t frame_samples = layout_of(format).samples;
  const std::vector<Sample> sent = wall(12 * frame_samples + 1);
  SampleDecoder decoder(format);
  const DecodedSamples received = decode(decoder, encode(format, sent));
  const bool delayed = format != SampleFormat::standard && format != SampleFormat::hq;
  ASSERT_EQ(received.size(), format == SampleFormat::standard ? sent.size() - 1
                             : delayed                        ? 11 * frame_samples
                                                              : 12 * frame_samples);
  EXPECT_EQ(decoder.counts().skipped_bytes, 0u);
  EXPECT_EQ(decoder.counts().restarts, 0u);
  for (std::size_t i = 0; i < received.size(); ++i) {
    ASSERT_LE(std::abs(turn(sent[i].angle_q16, received[i].angle_q16)), angle_tolerance) << i;
    ASSERT_EQ(received[i].distance_q2 == 0, sent[i].distance_q2 == 0) << i;
    ASSERT_LE(
        std::abs(static_cast<int>(received[i].distance_q2) - static_cast<int>(sent[i].distance_q2)),
        distance_tolerance)
        << i;
    ASSERT_TRUE(sent[i].distance_q2 == 0 || received[i].quality == quality) << i;
    ASSERT_EQ(received[i].after_gap, i == 0);
  }
}

// Angles: half of 1/64 degree at either end, or of the format's own step, and less than 1/65536 a
// point. Ultra capsules are read up to 24 mm beside the axis: 24/2100 in radians.
INSTANTIATE_TEST_SUITE_P(OfEachFormat, RoundTrip,
                         testing::Values(Tolerance{SampleFormat::standard, 512, 0, 200},
                                         Tolerance{SampleFormat::express, 1200, 2, 188},
                                         Tolerance{SampleFormat::hq, 180, 0, 200},
                                         Tolerance{SampleFormat::ultra, 44000, 10, 188},
                                         Tolerance{SampleFormat::dense, 1200, 2, 188},
                                         Tolerance{SampleFormat::ultra_dense, 1200, 6, 200}));

TEST(SampleEncoder, KeepsPointsThatLagBehindInExpressCapsules) {
  std::vector<Sample> sent = wall(64);
  sent[10].angle_q16 -= 9u << 14;  // 2.25 degrees
  const DecodedSamples received =
      decode(SampleFormat::express, encode(SampleFormat::express, sent));
  ASSERT_EQ(received.size(), 32u);
  for (std::size_t i = 0; i < received.size(); ++i) {
    EXPECT_LE(std::abs(turn(sent[i].angle_q16, received[i].angle_q16)), 4096 + 1200) << i;
  }
}

TEST(SampleEncoder, SendsNoReturnForWhatDoesNotFit) {
  const auto through = [](SampleFormat format, std::uint32_t distance_q2) {
    std::vector<Sample> samples(2 * layout_of(format).samples + 1);
    for (Sample& sample : samples) sample.distance_q2 = distance_q2;
    return decode(format, encode(format, samples)).at(0).distance_q2;
  };
  EXPECT_EQ(through(SampleFormat::standard, 65535), 65535u);
  EXPECT_EQ(through(SampleFormat::standard, 65536), 0u);
  EXPECT_EQ(through(SampleFormat::express, 65532), 65532u);
  EXPECT_EQ(through(SampleFormat::express, 65536), 0u);
  EXPECT_EQ(through(SampleFormat::dense, 262140), 262140u);
  EXPECT_EQ(through(SampleFormat::dense, 262144), 0u);
  EXPECT_EQ(through(SampleFormat::dense, 0xFFFFFFFF), 0u);
  EXPECT_EQ(through(SampleFormat::ultra, 4 * 28656), 4u * 28656u);
  EXPECT_EQ(through(SampleFormat::ultra, 4 * 30000), 0u);
  EXPECT_EQ(through(SampleFormat::ultra_dense, 262088), 262088u);
  EXPECT_EQ(through(SampleFormat::ultra_dense, 263000), 0u);
  EXPECT_EQ(through(SampleFormat::hq, 0xFFFFFFFF), 0xFFFFFFFFu);
}

TEST(SampleEncoder, LeansOnTheNextUltraPointWhereOneIsMissing) {
  std::vector<Sample> samples(2 * 96, Sample{0, 12000, 0});
  samples[3].distance_q2 = 0;
  const DecodedSamples received = decode(SampleFormat::ultra, encode(SampleFormat::ultra, samples));
  ASSERT_EQ(received.size(), 96u);
  EXPECT_EQ(received[1].distance_q2, 12000u);
  // A distance of 3 m is out of reach from the missing one behind it.
  EXPECT_EQ(received[2].distance_q2, 0u);
  EXPECT_EQ(received[3].distance_q2, 0u);
  EXPECT_EQ(received[4].distance_q2, 12000u);
  EXPECT_EQ(received[5].distance_q2, 12000u);
}

TEST(SampleEncoder, LacksTheLastUltraPointWithoutTheOneBehind) {
  SampleEncoder encoder(SampleFormat::ultra);
  const std::vector<Sample> samples(96, Sample{0, 4000, 0});
  Bytes bytes;
  encoder.encode(samples, 0, bytes);
  encoder.encode(samples, 0, bytes);
  const DecodedSamples received = decode(SampleFormat::ultra, bytes);
  ASSERT_EQ(received.size(), 96u);
  EXPECT_EQ(received[94].distance_q2, 4000u);
  EXPECT_EQ(received[95].distance_q2, 0u);
}

TEST(SampleEncoder, MarksTheStartOfTheStreamOrOfEachRevolution) {
  const std::vector<Sample> samples = random_samples(2000, 5);
  const Bytes capsules = encode(SampleFormat::dense, samples);
  for (std::size_t i = 0; i < capsules.size(); i += 84) {
    EXPECT_EQ(capsules[i + 3] >> 7, i == 0 ? 1 : 0);
  }
  const Bytes nodes = encode(SampleFormat::standard, samples);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_EQ((nodes[5 * i] & 1) != 0, samples[i].angle_q16 < samples[i - 1].angle_q16);
  }
}

TEST(SampleEncoder, RefusesOtherNumbersOfSamples) {
  SampleEncoder encoder(SampleFormat::dense);
  Bytes bytes;
  EXPECT_THROW(encoder.encode(std::vector<Sample>(39), 0, bytes), std::invalid_argument);
  EXPECT_THROW(encoder.encode(std::vector<Sample>(42), 0, bytes), std::invalid_argument);
  EXPECT_TRUE(bytes.empty());
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
