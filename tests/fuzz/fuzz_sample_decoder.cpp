// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as measurements. Byte 0 chooses the format, and with its highest bit that the rest is
// made frames with right checksums; byte 1 chooses how the rest is split into pieces.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>
#include <vector>

#include "sensor_bridge/rplidar/protocol/capsule.hpp"
#include "sensor_bridge/rplidar/protocol/checksum.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"
#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "tests/fuzz/require.hpp"

namespace {

using namespace quoin::sensor_bridge::rplidar;
using quoin::fuzz::require;

constexpr double sample_period = 108e-6;

struct DecodedSample {
  std::uint32_t angle_q16;
  std::uint32_t distance_q2;
  std::uint8_t quality;
  bool after_gap;

  friend bool operator==(const DecodedSample&, const DecodedSample&) = default;
};

/// Without this hardly any input passes a checksum.
void seal(SampleFormat format, std::span<std::uint8_t> bytes) {
  const std::size_t size = layout_of(format).bytes;
  for (; bytes.size() >= size; bytes = bytes.subspan(size)) {
    const std::span<std::uint8_t> frame = bytes.first(size);
    if (format == SampleFormat::standard) {
      frame[0] = static_cast<std::uint8_t>((frame[0] & 0xFE) | (~frame[0] >> 1 & 1));
      frame[1] |= 1;
    } else if (format == SampleFormat::hq) {
      frame[0] = 0xA5;
      store(frame.data() + size - 4, padded_crc32(frame.first(size - 4)));
    } else {
      const std::uint8_t sum = xor_checksum(frame.subspan(capsule_sync_bytes));
      frame[0] = static_cast<std::uint8_t>(0xA0 | (sum & 0xF));
      frame[1] = static_cast<std::uint8_t>(0x50 | sum >> 4);
    }
  }
}

void check_block(const SampleBlock& block, SampleFormat format) {
  require(block.size > 0 && block.size <= SampleBlock::capacity, "a block has 1 to 96 samples");
  // The last two of an ultra capsule lean on the next one, which may be missing.
  const std::size_t cut_off = format == SampleFormat::ultra ? 2 : 0;
  require(format == SampleFormat::standard || block.size == layout_of(format).samples ||
              block.size + cut_off == layout_of(format).samples,
          "a capsule gives all of its samples");
  require(block.age + 1 >= block.size, "the last sample of a block has arrived");
  for (std::size_t i = 0; i < block.size; ++i) {
    require(block.angle_q16[i] < full_circle_q16, "angles are below the full circle");
  }
}

void check_revolution(const Revolution& revolution) {
  const std::size_t size = revolution.angle_q16.size();
  require(size <= RevolutionAssembler::largest_revolution + SampleBlock::capacity &&
              revolution.distance_q2.size() == size && revolution.quality.size() == size &&
              revolution.time_offset.size() == size,
          "a revolution has as many angles as distances, qualities and times");
  require(revolution.begin <= revolution.end, "a revolution ends behind its begin");
  for (std::size_t i = 1; i < size; ++i) {
    require(revolution.time_offset[i - 1] < revolution.time_offset[i], "time goes on");
  }
}

/// All samples of the bytes, given in pieces of up to `largest_piece` bytes.
std::vector<DecodedSample> decode(SampleFormat format, std::span<const std::uint8_t> bytes,
                                  std::size_t largest_piece, unsigned seed, DecoderCounts& counts) {
  SampleDecoder decoder(format);
  RevolutionAssembler assembler(sample_period, 0.0);
  std::minstd_rand random(seed + 1);
  std::vector<DecodedSample> samples;
  Revolution revolution;
  SampleBlock block;
  TimePoint arrival;
  while (!bytes.empty()) {
    const std::size_t size = std::min(
        bytes.size(), largest_piece < bytes.size() ? 1 + random() % largest_piece : bytes.size());
    std::span<const std::uint8_t> piece = bytes.first(size);
    bytes = bytes.subspan(size);
    arrival += std::chrono::microseconds(random() % 5000);
    std::size_t left = piece.size();
    while (decoder.next(piece, block)) {
      check_block(block, format);
      require(piece.size() <= left, "a decoder takes bytes from the front");
      left = piece.size();
      for (std::size_t i = 0; i < block.size; ++i) {
        samples.push_back({block.angle_q16[i], block.distance_q2[i], block.quality[i],
                           block.after_gap && i == 0});
      }
      if (assembler.add(block, arrival, revolution)) check_revolution(revolution);
    }
    require(piece.empty(), "a decoder takes all bytes");
  }
  counts = decoder.counts();
  return samples;
}

void check_counts(const DecoderCounts& counts, SampleFormat format, std::size_t bytes,
                  std::size_t samples) {
  const FrameLayout layout = layout_of(format);
  const std::size_t accounted = counts.skipped_bytes + counts.frames * layout.bytes;
  const std::size_t held = format == SampleFormat::standard ? 8 * layout.bytes : layout.bytes + 2;
  require(accounted <= bytes && bytes - accounted < held, "each byte is accounted for");
  require(counts.samples == samples, "samples are counted");
  require(counts.checksum_errors <= counts.skipped_bytes, "a damaged frame is passed over");
  require(counts.out_of_line + counts.restarts <= counts.frames, "only frames can disagree");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const SampleFormat format = sample_formats[(data[0] & 0x7F) % std::size(sample_formats)];
  std::vector<std::uint8_t> bytes(data + 2, data + size);
  if ((data[0] & 0x80) != 0) seal(format, bytes);

  DecoderCounts counts;
  const std::vector<DecodedSample> whole = decode(format, bytes, bytes.size(), 0, counts);
  check_counts(counts, format, bytes.size(), whole.size());
  DecoderCounts counts_of_pieces;
  const std::vector<DecodedSample> pieces =
      decode(format, bytes, std::size_t{1} << (data[1] & 7), data[1], counts_of_pieces);
  require(whole == pieces, "the samples do not depend on how the bytes arrive");
  require(counts == counts_of_pieces, "the counts do not depend on how the bytes arrive");
  return 0;
}
