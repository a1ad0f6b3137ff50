// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <random>
#include <span>
#include <vector>

#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "sensor_bridge/rplidar/protocol/sample_encoder.hpp"
#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"

namespace quoin::sensor_bridge::rplidar {

inline constexpr double sample_period = 108e-6;

/// A sample as a decoder gives it.
struct DecodedSample {
  std::uint32_t angle_q16 = 0;
  std::uint32_t distance_q2 = 0;
  unsigned quality = 0;
  bool after_gap = false;

  friend bool operator==(const DecodedSample&, const DecodedSample&) = default;
  friend std::ostream& operator<<(std::ostream& stream, const DecodedSample& sample) {
    return stream << '{' << sample.angle_q16 << ", " << sample.distance_q2 << ", " << sample.quality
                  << (sample.after_gap ? ", after a gap}" : "}");
  }
};

using DecodedSamples = std::vector<DecodedSample>;

/// Gives the decoder the bytes in pieces of the sizes that `next_size` names.
inline DecodedSamples decode(SampleDecoder& decoder, std::span<const std::uint8_t> bytes,
                             const std::function<std::size_t()>& next_size) {
  DecodedSamples samples;
  SampleBlock block;
  while (!bytes.empty()) {
    std::span<const std::uint8_t> piece = bytes.first(std::min(next_size(), bytes.size()));
    bytes = bytes.subspan(piece.size());
    while (decoder.next(piece, block)) {
      for (std::size_t i = 0; i < block.size; ++i) {
        samples.push_back({block.angle_q16[i], block.distance_q2[i], block.quality[i],
                           block.after_gap && i == 0});
      }
    }
  }
  return samples;
}

inline DecodedSamples decode(SampleDecoder& decoder, std::span<const std::uint8_t> bytes) {
  return decode(decoder, bytes, [&] { return bytes.size(); });
}

inline DecodedSamples decode(SampleFormat format, std::span<const std::uint8_t> bytes) {
  SampleDecoder decoder(format);
  return decode(decoder, bytes);
}

/// Samples of a sensor that turns ten times a second, with random distances of 3 to 15 m and
/// qualities.
inline std::vector<Sample> random_samples(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::uint32_t> distance(12000, 60000);
  std::uniform_int_distribution<std::uint32_t> quality(1, 63);
  std::vector<Sample> samples(count);
  std::uint32_t angle = 350u << 16;
  for (Sample& sample : samples) {
    sample = {angle, distance(random), static_cast<std::uint8_t>(quality(random) << 2)};
    angle = (angle + full_circle_q16 / 926) % full_circle_q16;
  }
  return samples;
}

/// All whole frames of the samples, one behind the other.
inline Bytes encode(SampleFormat format, std::span<const Sample> samples) {
  SampleEncoder encoder(format);
  const std::size_t size = layout_of(format).samples;
  Bytes bytes;
  for (; samples.size() >= size; samples = samples.subspan(size)) {
    encoder.encode(samples.first(std::min(samples.size(), size + 1)), 1000, bytes);
  }
  return bytes;
}

/// A dense capsule of 40 equal distances: an even number of these takes itself out of the checksum.
inline Bytes dense_capsule(unsigned start_q6, unsigned distance, bool first = false) {
  const unsigned start = start_q6 | (first ? 0x8000 : 0);
  const unsigned sum = (start & 0xFF) ^ start >> 8;
  Bytes bytes{static_cast<std::uint8_t>(0xA0 | (sum & 0xF)),
              static_cast<std::uint8_t>(0x50 | sum >> 4), static_cast<std::uint8_t>(start),
              static_cast<std::uint8_t>(start >> 8)};
  for (int k = 0; k < 40; ++k) {
    bytes.push_back(static_cast<std::uint8_t>(distance));
    bytes.push_back(static_cast<std::uint8_t>(distance >> 8));
  }
  return bytes;
}

}  // namespace quoin::sensor_bridge::rplidar
