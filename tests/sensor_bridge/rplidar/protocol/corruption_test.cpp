// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// A stream with one byte dropped, changed or put in, at every place.
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/sample_stream.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::size_t frames = 6;

constexpr std::uint8_t inserted = 0x3C;

enum class Damage { drop, change, insert };

Bytes damaged(Bytes bytes, Damage damage, std::size_t place) {
  const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(place);
  switch (damage) {
    case Damage::drop:
      bytes.erase(at);
      break;
    case Damage::change:
      *at ^= 0x55;
      break;
    case Damage::insert:
      bytes.insert(at, inserted);
      break;
  }
  return bytes;
}

/// All samples but those of the frames from `first_lost` to before `first_kept`.
DecodedSamples without(DecodedSamples samples, std::size_t first_lost, std::size_t first_kept,
                       std::size_t frame_samples) {
  const auto place = [&](std::size_t frame) {
    return samples.begin() +
           static_cast<std::ptrdiff_t>(std::min(frame * frame_samples, samples.size()));
  };
  const auto kept = samples.erase(place(first_lost), place(first_kept));
  if (kept != samples.end()) kept->after_gap = true;
  return samples;
}

/// Whether what the damage moves out of its frame is the same as what it moves in: a checksum of
/// eight bits does not see that.
bool hides_damage(const Bytes& bytes, Damage damage, std::size_t place, std::size_t frame_bytes) {
  const std::size_t next_frame = (place / frame_bytes + 1) * frame_bytes;
  if (damage == Damage::insert) return bytes[next_frame - 1] == inserted;
  return next_frame < bytes.size() && bytes[place] == bytes[next_frame];
}

/// The same samples in front of one place and from another one on.
void expect_same_outside(const DecodedSamples& samples, const DecodedSamples& all,
                         std::size_t begin, std::size_t end) {
  ASSERT_GE(samples.size(), begin);
  EXPECT_TRUE(
      std::equal(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(begin), samples.begin()));
  if (end >= all.size()) return;
  const auto behind = static_cast<std::ptrdiff_t>(all.size() - end);
  ASSERT_GE(samples.size(), begin + all.size() - end);
  // The very first of them may follow a gap.
  EXPECT_TRUE(std::equal(all.end() - behind + 1, all.end(), samples.end() - behind + 1));
}

class Capsules : public testing::TestWithParam<SampleFormat> {};

TEST_P(Capsules, LoseExactlyWhatTheDamageTouches) {
  const SampleFormat format = GetParam();
  const FrameLayout layout = layout_of(format);
  const Bytes bytes = encode(format, random_samples(frames * layout.samples, 7));
  const DecodedSamples all = decode(format, bytes);
  // A capsule that needs the next one to be read is lost with it.
  const std::size_t before = format == SampleFormat::hq ? 0 : 1;
  ASSERT_EQ(all.size(), (frames - before) * layout.samples);
  for (const Damage damage : {Damage::drop, Damage::change, Damage::insert}) {
    for (std::size_t place = 0; place < bytes.size(); ++place) {
      const std::size_t frame = place / layout.bytes;
      // A byte between two capsules leaves both of them whole, but hides whether others are
      // missing.
      const bool between = damage == Damage::insert && place % layout.bytes == 0;
      const std::size_t first_lost = frame - std::min(frame, before);
      const std::size_t first_kept = between ? frame : frame + 1;
      if (damage != Damage::change && !between &&
          hides_damage(bytes, damage, place, layout.bytes)) {
        const DecodedSamples samples = decode(format, damaged(bytes, damage, place));
        expect_same_outside(samples, all, first_lost * layout.samples,
                            (frame + 2) * layout.samples);
        continue;
      }
      SampleDecoder decoder(format);
      ASSERT_EQ(decode(decoder, damaged(bytes, damage, place)),
                without(all, first_lost, first_kept, layout.samples))
          << format_name(format) << ", damage " << static_cast<int>(damage) << " at byte " << place;
      EXPECT_LE(decoder.counts().checksum_errors, 1u);
      EXPECT_EQ(decoder.counts().restarts + decoder.counts().out_of_line, 0u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachFormat, Capsules,
                         testing::Values(SampleFormat::express, SampleFormat::hq,
                                         SampleFormat::ultra, SampleFormat::dense,
                                         SampleFormat::ultra_dense));

// Nodes have no checksum: what damage leaves may look like a node, until one does not.
TEST(Nodes, AreInStepAgainSoonAfterDamage) {
  constexpr std::size_t count = 400;
  const Bytes bytes = encode(SampleFormat::standard, random_samples(count, 8));
  const DecodedSamples all = decode(SampleFormat::standard, bytes);
  ASSERT_EQ(all.size(), count - 1);
  std::size_t most_wrong = 0;
  std::size_t most_lost = 0;
  for (const Damage damage : {Damage::drop, Damage::change, Damage::insert}) {
    for (std::size_t place = 0; place < 5 * (count - 30); ++place) {
      DecodedSamples samples = decode(SampleFormat::standard, damaged(bytes, damage, place));
      for (std::size_t i = 1; i < samples.size(); ++i) samples[i].after_gap = false;
      const auto first_wrong = static_cast<std::size_t>(
          std::mismatch(samples.begin(), samples.end(), all.begin(), all.end()).first -
          samples.begin());
      ASSERT_GE(first_wrong + 1, place / 5) << place;
      const auto same_behind = static_cast<std::size_t>(
          std::mismatch(samples.rbegin(), samples.rend(), all.rbegin(), all.rend()).first -
          samples.rbegin());
      ASSERT_GT(same_behind, 0u) << place;
      if (first_wrong + same_behind >= samples.size()) continue;
      most_wrong = std::max(most_wrong, samples.size() - same_behind - first_wrong);
      most_lost = std::max(most_lost, all.size() - same_behind - first_wrong);
    }
  }
  // Of what is no node fewer than one in four look like one.
  RecordProperty("most_wrong", std::to_string(most_wrong));
  EXPECT_LE(most_wrong, 2u);
  EXPECT_LE(most_lost, 5u);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
