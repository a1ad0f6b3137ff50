// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames laid out here from the tables of the protocol, bit by bit and apart from SampleEncoder,
// with every word that a format has; what is read of them is computed from the same tables.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using Frame = std::vector<unsigned>;  // bytes

void put(Frame& frame, std::size_t at, unsigned long value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) frame.at(at + i) = (value >> 8 * i) & 0xFF;
}

/// The angle is that of a sensor that turns by 16 degrees in a frame.
class Capsules {
 public:
  Capsules(SampleFormat format, std::size_t bytes, std::size_t angle_at)
      : decoder_(format), bytes_(bytes), angle_at_(angle_at) {}

  [[nodiscard]] Frame blank() const { return Frame(bytes_); }

  /// The samples of the frame before, if there is one.
  [[nodiscard]] bool read(Frame frame, SampleBlock& block) {
    put(frame, angle_at_, (start_ % 360) * 64 | (start_ == 0 ? 0x8000U : 0U), 2);
    unsigned sum = 0;
    for (std::size_t i = 2; i < frame.size(); ++i) sum ^= frame[i];
    frame[0] = 0xA0 | (sum & 15);
    frame[1] = 0x50 | sum >> 4;
    start_ += 16;
    const std::vector<std::uint8_t> bytes(frame.begin(), frame.end());
    std::span<const std::uint8_t> rest(bytes);
    return decoder_.next(rest, block);
  }
  /// [deg] where the frame begins that was read last but one.
  [[nodiscard]] double start() const { return (start_ - 32) % 360; }

 private:
  SampleDecoder decoder_;
  std::size_t bytes_;
  std::size_t angle_at_;
  unsigned start_ = 0;
};

double degrees(std::uint32_t angle_q16) { return angle_q16 / 65536.0; }

double apart(double a, double b) {
  const double turn = std::abs(std::remainder(a - b, 360.0));
  return turn;
}

TEST(EveryWord, OfDenseCapsules) {
  Capsules capsules(SampleFormat::dense, 84, 2);
  SampleBlock block;
  std::vector<unsigned> words;
  for (unsigned word = 0; word < 0x10000 + 80; word += 40) {
    Frame frame = capsules.blank();
    for (unsigned k = 0; k < 40; ++k) put(frame, 4 + 2 * k, (word + k) & 0xFFFF, 2);
    if (!capsules.read(frame, block)) continue;
    for (unsigned k = 0; k < 40; ++k) {
      ASSERT_EQ(block.distance_q2[k], ((word - 40 + k) & 0xFFFF) * 4);
      ASSERT_LT(apart(degrees(block.angle_q16[k]), capsules.start() + k * 16.0 / 40), 1e-3);
    }
  }
}

TEST(EveryWord, OfExpressCapsules) {
  Capsules capsules(SampleFormat::express, 84, 2);
  SampleBlock block;
  struct Point {
    unsigned word;
    unsigned low;  // bits of the correction
  };
  std::vector<Point> points(32);
  for (unsigned word = 0; word < 0x10000 + 64; word += 32) {
    const std::vector<Point> before = points;
    Frame frame = capsules.blank();
    for (unsigned k = 0; k < 32; ++k) {
      points[k] = {(word + k) & 0xFFFF, (word / 7 + k * 5) & 15};
      put(frame, 4 + k / 2 * 5 + k % 2 * 2, points[k].word, 2);
      frame[4 + k / 2 * 5 + 4] |= points[k].low << (k % 2 * 4);
    }
    if (!capsules.read(frame, block)) continue;
    for (unsigned k = 0; k < 32; ++k) {
      const double correction = ((before[k].word & 3) * 16 + before[k].low) / 8.0;
      ASSERT_EQ(block.distance_q2[k], before[k].word / 4 * 4);
      ASSERT_LT(apart(degrees(block.angle_q16[k]), capsules.start() + k * 0.5 - correction), 1e-3);
    }
  }
}

/// Millimetres of a 12-bit code and the step of its scale.
std::pair<unsigned, unsigned> scaled(unsigned code) {
  if (code >= 3328) return {16384 + (code - 3328) * 16, 16};
  if (code >= 1792) return {4096 + (code - 1792) * 8, 8};
  if (code >= 1280) return {2048 + (code - 1280) * 4, 4};
  if (code >= 512) return {512 + (code - 512) * 2, 2};
  return {code, 1};
}

/// Each distance code with each prediction from it and to it.
TEST(EveryWord, OfUltraCapsules) {
  Capsules capsules(SampleFormat::ultra, 132, 2);
  SampleBlock block;
  struct Cabin {
    unsigned major;
    int first;
    int second;
  };
  const auto predicted = [](std::pair<unsigned, unsigned> base, int steps) -> long {
    if (steps == -512 || steps == 511) return 0;
    return std::max(0L, static_cast<long>(base.first) + static_cast<long>(base.second) * steps);
  };
  std::vector<Cabin> cabins(32);
  std::vector<Cabin> before;
  for (unsigned count = 0; count < 4096 * 1024 + 64;) {
    before = cabins;
    Frame frame = capsules.blank();
    for (std::size_t k = 0; k < 32; ++k, ++count) {
      // 4097 steps through all pairs of 4096 codes and 1024 predictions.
      const int first = static_cast<int>(count / 4096 % 1024) - 512;
      cabins[k] = {count % 4096, first, -1 - first};
      put(frame, 4 + 4 * k,
          cabins[k].major | (static_cast<unsigned>(cabins[k].first) & 0x3FF) << 12 |
              static_cast<unsigned long>(static_cast<unsigned>(cabins[k].second) & 0x3FF) << 22,
          4);
    }
    if (!capsules.read(frame, block)) continue;
    for (std::size_t k = 0; k < 32; ++k) {
      const auto major = scaled(before[k].major);
      const auto next = scaled(k < 31 ? before[k + 1].major : cabins[0].major);
      const auto base = major.first == 0 && next.first != 0 ? next : major;
      ASSERT_EQ(block.distance_q2[3 * k], major.first * 4);
      ASSERT_EQ(block.distance_q2[3 * k + 1], predicted(base, before[k].first) * 4);
      ASSERT_EQ(block.distance_q2[3 * k + 2], predicted(next, before[k].second) * 4);
    }
    // The optics look from 24 mm beside the axis; 8 degrees are taken off.
    const double far = block.distance_q2[0] / 4000.0;
    if (far > 1.0) {
      const double offset = 8.0 - 0.02401 / far * 180.0 / std::numbers::pi;
      ASSERT_LT(apart(degrees(block.angle_q16[0]), capsules.start() - offset), 0.06) << far;
    }
  }
}

TEST(EveryWord, OfUltraDenseCapsules) {
  Capsules capsules(SampleFormat::ultra_dense, 170, 8);
  SampleBlock block;
  // Scale: shift of the quality, its step, factor and begin of the distance [1/4 mm].
  struct Scale {
    unsigned bits, step, factor, begin;
  };
  constexpr Scale scales[] = {
      {12, 1, 2, 0}, {13, 2, 3, 8184}, {14, 4, 4, 32748}, {15, 8, 5, 98268}};
  std::vector<unsigned> words(64);
  for (unsigned word = 0; word < (1U << 20) + 64; word += 32) {
    const std::vector<unsigned> before = words;
    Frame frame = capsules.blank();
    for (unsigned k = 0; k < 64; ++k) {
      // Nothing beside each word: near distances are smoothed with their neighbours.
      words[k] = k % 2 == 0 ? (word + k / 2) & 0xFFFFF : 0;
      put(frame, 10 + k / 2 * 5 + k % 2 * 2, words[k] & 0xFFFF, 2);
      frame[10 + k / 2 * 5 + 4] |= words[k] >> 16 << (k % 2 * 4);
    }
    if (!capsules.read(frame, block)) continue;
    for (unsigned k = 0; k < 64; ++k) {
      const Scale& scale = scales[before[k] & 3];
      const unsigned distance = before[k] & ((1U << scale.bits) - 4);
      ASSERT_EQ(block.distance_q2[k], distance * scale.factor + scale.begin) << before[k];
      ASSERT_EQ(block.quality[k], (before[k] >> scale.bits) * scale.step) << before[k];
      ASSERT_LT(apart(degrees(block.angle_q16[k]), capsules.start() + k * 0.25), 1e-3);
    }
  }
}

TEST(EveryWord, OfStandardNodes) {
  SampleDecoder decoder(SampleFormat::standard);
  SampleBlock block;
  unsigned last = 0;
  std::size_t read = 0;
  // Each angle and each distance; qualities go round.
  for (unsigned count = 0; count < 0x10000 + 1; ++count) {
    const unsigned angle = count * 16 % 23040;
    const unsigned quality = count % 64;
    const std::vector<std::uint8_t> node{
        static_cast<std::uint8_t>(quality << 2 | 2), static_cast<std::uint8_t>(angle << 1 | 1),
        static_cast<std::uint8_t>(angle >> 7), static_cast<std::uint8_t>(count),
        static_cast<std::uint8_t>(count >> 8)};
    std::span<const std::uint8_t> rest(node);
    if (decoder.next(rest, block)) {
      ASSERT_EQ(block.size, 1U);
      ASSERT_EQ(block.distance_q2[0], last & 0xFFFF);
      ASSERT_EQ(block.angle_q16[0], (last * 16 % 23040) << 10);
      ASSERT_EQ(block.quality[0], (last % 64) << 2);
      ++read;
    }
    last = count;
  }
  EXPECT_EQ(read, 0x10000U);
}

TEST(EveryWord, OfHqCapsules) {
  SampleDecoder decoder(SampleFormat::hq);
  SampleBlock block;
  std::uint32_t distance = 1;
  for (unsigned count = 0; count < 0x10000; count += 96) {
    Frame frame(781);
    frame[0] = 0xA5;
    put(frame, 1, count, 8);
    std::vector<std::uint32_t> distances;
    for (unsigned k = 0; k < 96; ++k) {
      distance = distance * 1664525 + 1013904223;
      distances.push_back(distance);
      put(frame, 9 + 8 * k, (count + k) & 0xFFFF, 2);
      put(frame, 9 + 8 * k + 2, distance, 4);
      frame[9 + 8 * k + 6] = (count + k) & 0xFF;
    }
    // CRC-32 of zip over the bytes before it and three zeros.
    std::uint32_t crc = 0xFFFFFFFF;
    for (std::size_t i = 0; i < 777 + 3; ++i) {
      crc ^= i < 777 ? frame[i] : 0;
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
    }
    put(frame, 777, ~crc, 4);
    const std::vector<std::uint8_t> bytes(frame.begin(), frame.end());
    std::span<const std::uint8_t> rest(bytes);
    ASSERT_TRUE(decoder.next(rest, block));
    for (unsigned k = 0; k < 96; ++k) {
      ASSERT_EQ(block.distance_q2[k], distances[k]);
      ASSERT_DOUBLE_EQ(degrees(block.angle_q16[k]), ((count + k) & 0xFFFF) * 90.0 / 16384);
      ASSERT_EQ(block.quality[k], (count + k) & 0xFF);
    }
  }
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
