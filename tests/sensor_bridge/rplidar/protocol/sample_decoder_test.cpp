// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/sample_stream.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

/// The same from a whole number of degrees on.
Bytes dense_capsule_at(unsigned start_degrees, bool first = false, unsigned distance = 0) {
  return dense_capsule(start_degrees * 64, distance, first);
}

TEST(SampleDecoder, TellsTheAgeOfABlock) {
  SampleBlock block;
  for (const SampleFormat format : sample_formats) {
    const FrameLayout layout = layout_of(format);
    const Bytes bytes = encode(format, random_samples(2 * layout.samples, 1));
    SampleDecoder decoder(format);
    std::span<const std::uint8_t> rest = bytes;
    ASSERT_TRUE(decoder.next(rest, block)) << format_name(format);
    if (format == SampleFormat::standard) {
      EXPECT_EQ(block.size, 1u);
      EXPECT_EQ(block.age, 1u);
    } else {
      EXPECT_EQ(block.size, layout.samples);
      EXPECT_EQ(block.age, (format == SampleFormat::hq ? 1 : 2) * layout.samples - 1);
    }
    EXPECT_TRUE(block.after_gap);
    EXPECT_EQ(decoder.counts().samples, block.size);
    EXPECT_EQ(decoder.counts().skipped_bytes, 0u);
  }
}

TEST(SampleDecoder, GivesTheSameSamplesHoweverTheBytesArrive) {
  std::mt19937 random(20260422);
  for (const SampleFormat format : sample_formats) {
    const std::size_t frame_bytes = layout_of(format).bytes;
    Bytes bytes =
        hex("A5 5A 3D A0 51") +
        encode(format,
               random_samples(std::max<std::size_t>(12 * layout_of(format).samples, 200), 2));
    for (int damage = 0; damage < 3; ++damage) bytes[random() % bytes.size()] ^= 0x10;
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(7 * frame_bytes));

    SampleDecoder whole(format);
    const DecodedSamples expected = decode(whole, bytes);
    ASSERT_FALSE(expected.empty());
    SampleDecoder single(format);
    EXPECT_EQ(decode(single, bytes, [] { return 1; }), expected) << format_name(format);
    EXPECT_EQ(single.counts(), whole.counts()) << format_name(format);
    for (std::size_t largest = 2; largest < 2 * frame_bytes; largest += largest / 3 + 1) {
      SampleDecoder pieces(format);
      EXPECT_EQ(decode(pieces, bytes, [&] { return 1 + random() % largest; }), expected);
      EXPECT_EQ(pieces.counts(), whole.counts()) << format_name(format);
    }
  }
}

TEST(SampleDecoder, CountsTheSameWhenAFalseBeginComesAlone) {
  const Bytes good = dense_capsule_at(0, true, 100) + dense_capsule_at(4, false, 200);
  const Bytes bytes = good + hex("A0") + dense_capsule_at(8, false, 300) + dense_capsule_at(12);
  SampleDecoder decoder(SampleFormat::dense);
  std::size_t size = good.size() + 1;
  const DecodedSamples samples = decode(decoder, bytes, [&] { return std::exchange(size, 1000); });
  EXPECT_EQ(samples.size(), 80u);
  EXPECT_EQ(decoder.counts(), (DecoderCounts{4, 80, 0, 1, 0, 0}));
}

TEST(SampleDecoder, HandsOutEachNodeWithTheNextOne) {
  const Bytes bytes = encode(SampleFormat::standard, random_samples(250, 3));
  SampleDecoder decoder(SampleFormat::standard);
  SampleBlock block;
  std::span<const std::uint8_t> node = std::span(bytes).first(5);
  EXPECT_FALSE(decoder.next(node, block));
  node = std::span(bytes).subspan(5, 5);
  ASSERT_TRUE(decoder.next(node, block));
  EXPECT_EQ(block.size, 1u);
  EXPECT_EQ(block.age, 1u);
  node = std::span(bytes).subspan(10, 4);
  EXPECT_FALSE(decoder.next(node, block));
  // The last byte of one node and all of the others.
  std::span<const std::uint8_t> rest = std::span(bytes).subspan(14);
  std::vector<std::size_t> sizes;
  while (decoder.next(rest, block)) {
    sizes.push_back(block.size);
    EXPECT_FALSE(block.after_gap);
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{96, 96, 56}));
}

TEST(SampleDecoder, StartsAnewWhenTheDeviceDoes) {
  SampleDecoder decoder(SampleFormat::dense);
  const DecodedSamples samples =
      decode(decoder, dense_capsule_at(0, true, 100) + dense_capsule_at(4, false, 200) +
                          dense_capsule_at(8, true, 300) + dense_capsule_at(12, false, 400));
  // The second capsule leads nowhere: its end is not known.
  ASSERT_EQ(samples.size(), 80u);
  EXPECT_EQ(samples[0], (DecodedSample{0, 400, 188, true}));
  EXPECT_EQ(samples[40], (DecodedSample{8u << 16, 1200, 188, true}));
  EXPECT_EQ(decoder.counts(), (DecoderCounts{4, 80, 0, 0, 0, 1}));
}

TEST(SampleDecoder, TakesNoStepOfMoreThanHalfACircle) {
  SampleDecoder decoder(SampleFormat::dense);
  EXPECT_EQ(decode(decoder, dense_capsule_at(0, true) + dense_capsule_at(180)).size(), 40u);
  EXPECT_TRUE(decode(decoder, dense_capsule_at(1)).empty());
  EXPECT_EQ(decoder.counts().out_of_line, 1u);
}

TEST(SampleDecoder, TakesAStandingMotor) {
  const DecodedSamples samples =
      decode(SampleFormat::dense, dense_capsule_at(5, true) + dense_capsule_at(5));
  ASSERT_EQ(samples.size(), 40u);
  EXPECT_EQ(samples[39].angle_q16, 5u << 16);
}

TEST(SampleDecoder, TakesStartAnglesBeyondTheCircle) {
  const DecodedSamples samples =
      decode(SampleFormat::dense, dense_capsule_at(365, true) + dense_capsule_at(9));
  ASSERT_EQ(samples.size(), 40u);
  EXPECT_EQ(samples[0].angle_q16, 5u << 16);
  EXPECT_EQ(decode(SampleFormat::dense, dense_capsule_at(1, true) + dense_capsule_at(365)).size(),
            40u);
}

TEST(SampleDecoder, SmoothsUltraDenseCapsulesOnTheFinestScaleOnly) {
  std::vector<Sample> samples(2 * 64, Sample{0, 8176, 100});
  samples[1].distance_q2 = 8184;  // the first step of the second scale
  const DecodedSamples decoded =
      decode(SampleFormat::ultra_dense, encode(SampleFormat::ultra_dense, samples));
  ASSERT_EQ(decoded.size(), 64u);
  EXPECT_EQ(decoded[1].distance_q2, 8184u);
  EXPECT_EQ(decoded[2].distance_q2, 8180u);
}

TEST(SampleDecoder, SmoothsAcrossUltraDenseCapsulesButNotAcrossGaps) {
  // 1000 mm everywhere, then 1002 mm: the first point behind is the mean.
  std::vector<Sample> samples(4 * 64, Sample{0, 4000, 100});
  std::fill(samples.begin() + 128, samples.end(), Sample{0, 4008, 100});
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].angle_q16 = static_cast<std::uint32_t>(k << 14);
  }
  Bytes bytes = encode(SampleFormat::ultra_dense, samples);
  DecodedSamples decoded = decode(SampleFormat::ultra_dense, bytes);
  ASSERT_EQ(decoded.size(), 3u * 64u);
  EXPECT_EQ(decoded[127].distance_q2, 4000u);
  EXPECT_EQ(decoded[128].distance_q2, 4004u);
  // Without the capsule in front of the step.
  bytes = encode(SampleFormat::ultra_dense, std::span(samples).subspan(0, 128)) + hex("00") +
          std::span(bytes).subspan(2 * 170);
  decoded = decode(SampleFormat::ultra_dense, bytes);
  ASSERT_EQ(decoded.size(), 2u * 64u);
  EXPECT_EQ(decoded[64], (DecodedSample{32u << 16, 4008, 100, true}));
}

// 0x5AA5 mm: each distance looks like the begin of a capsule.
TEST(SampleDecoder, FindsCapsulesAmongWhatLooksLikeThem) {
  Bytes bytes;
  for (unsigned k = 0; k < 6; ++k) bytes = bytes + dense_capsule_at(4 * k, k == 0, 0x5AA5);
  const DecodedSamples expected = decode(SampleFormat::dense, bytes);
  ASSERT_EQ(expected.size(), 200u);
  for (std::size_t cut = 1; cut < 84; ++cut) {
    SampleDecoder decoder(SampleFormat::dense);
    DecodedSamples samples = decode(decoder, std::span(bytes).subspan(cut));
    ASSERT_EQ(samples.size(), 160u) << cut;
    EXPECT_TRUE(samples[0].after_gap);
    samples[0].after_gap = false;
    EXPECT_TRUE(std::equal(samples.begin(), samples.end(), expected.begin() + 40)) << cut;
    EXPECT_EQ(decoder.counts().skipped_bytes, 84 - cut);
  }
}

TEST(SampleDecoder, FindsACapsuleThatBeginsInsideADamagedOne) {
  const Bytes good = dense_capsule_at(4, false, 200) + dense_capsule_at(8, false, 300);
  for (std::size_t kept = 1; kept < 84; ++kept) {
    Bytes damaged = dense_capsule_at(0, true, 0x1122);
    damaged.resize(kept);
    SampleDecoder decoder(SampleFormat::dense);
    const DecodedSamples samples = decode(decoder, damaged + good);
    ASSERT_EQ(samples.size(), 40u) << kept;
    EXPECT_EQ(samples[0], (DecodedSample{4u << 16, 800, 188, true}));
    EXPECT_EQ(decoder.counts().skipped_bytes, kept);
  }
}

TEST(SampleDecoder, FindsNodesFromTheMiddleOfTheStream) {
  const Bytes bytes = encode(SampleFormat::standard, random_samples(200, 4));
  const DecodedSamples expected = decode(SampleFormat::standard, bytes);
  // The first bytes of a stream are taken on trust; these here show that they are none.
  const Bytes noise = hex("00 00 00");
  for (std::size_t cut = 0; cut < 5; ++cut) {
    const DecodedSamples samples =
        decode(SampleFormat::standard, noise + std::span(bytes).subspan(cut));
    ASSERT_GE(samples.size(), 195u);
    EXPECT_TRUE(std::equal(samples.end() - 190, samples.end(), expected.end() - 190)) << cut;
  }
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
