// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"

#include <algorithm>
#include <cstring>

#include "sensor_bridge/rplidar/protocol/capsule.hpp"
#include "sensor_bridge/rplidar/protocol/checksum.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::uint32_t full_circle_q6 = 360u << 6;
constexpr std::uint8_t hq_sync = 0xA5;
constexpr std::size_t node_bytes = layout_of(SampleFormat::standard).bytes;
/// Nodes have no checksum: behind damage so many must follow each other.
constexpr std::size_t confirming_bytes = 3 * node_bytes;

/// No device turns faster than 100 times a second, and half a circle between two capsules says
/// nothing.
std::uint32_t largest_difference_q6(SampleFormat format, double sample_period) {
  const double revolutions = 100.0 * sample_period * static_cast<double>(layout_of(format).samples);
  if (!(revolutions > 0.0 && revolutions < 0.5)) return full_circle_q6 / 2;
  return static_cast<std::uint32_t>(revolutions * full_circle_q6);
}

/// Whether a frame can begin here, judged by the bytes, of which there is one at least.
template <SampleFormat format>
bool may_begin(std::span<const std::uint8_t> bytes) {
  if constexpr (format == SampleFormat::hq) {
    return bytes[0] == hq_sync;
  } else {
    return (bytes[0] & 0xF0) == 0xA0 && (bytes.size() < 2 || (bytes[1] & 0xF0) == 0x50);
  }
}

/// Of a whole frame that may begin here.
template <SampleFormat format>
bool checksum_is_right(const std::uint8_t* frame) {
  constexpr std::size_t size = layout_of(format).bytes;
  if constexpr (format == SampleFormat::hq) {
    constexpr std::size_t content = size - sizeof(std::uint32_t);
    return padded_crc32({frame, content}) == load<std::uint32_t>(frame + content);
  } else {
    const unsigned sum = (frame[0] & 0xFu) | (frame[1] & 0xFu) << 4;
    return xor_checksum<size - capsule_sync_bytes>(frame + capsule_sync_bytes) == sum;
  }
}

/// The first index at which a frame may begin, or how many bytes there are.
template <SampleFormat format>
std::size_t begin_of_frame(std::span<const std::uint8_t> bytes) {
  std::size_t offset = 0;
  while (offset < bytes.size() && !may_begin<format>(bytes.subspan(offset))) ++offset;
  return offset;
}

/// Eight bits of checksum are few where a frame is searched for byte by byte: there the next one
/// must begin right behind it. That costs no time, as a capsule is read with the next one only.
constexpr std::size_t confirming_sync_bytes(SampleFormat format) {
  return format == SampleFormat::hq ? 0 : capsule_sync_bytes;
}

/// Whether the byte at this index of a row of nodes is possible.
bool fits_nodes(const std::uint8_t* nodes, std::size_t index) {
  const std::uint8_t byte = nodes[index];
  switch (index % node_bytes) {
    case 0:
      return ((byte ^ (byte >> 1)) & 1) != 0;
    case 1:
      return (byte & 1) != 0;
    case 2:
      // 360 degrees may come of rounding.
      return ((nodes[index - 1] >> 1) | byte << 7) <= static_cast<int>(full_circle_q6);
    default:
      return true;
  }
}

bool fit_nodes(std::span<const std::uint8_t> bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (!fits_nodes(bytes.data(), i)) return false;
  }
  return true;
}

void append_node(const std::uint8_t* node, SampleBlock& block) {
  const std::uint32_t angle_q6 = load<std::uint16_t>(node + 1) >> 1;
  block.angle_q16[block.size] = angle_q6 == full_circle_q6 ? 0 : angle_q6 << 10;
  block.distance_q2[block.size] = load<std::uint16_t>(node + 3);
  block.quality[block.size] = node[0] & 0xFC;
  ++block.size;
}

}  // namespace

SampleDecoder::SampleDecoder(SampleFormat format, double sample_period)
    : format_(format),
      largest_difference_q6_(rplidar::largest_difference_q6(format, sample_period)) {}

bool SampleDecoder::next(std::span<const std::uint8_t>& bytes, SampleBlock& block) {
  switch (format_) {
    case SampleFormat::standard:
      return next_nodes(bytes, block);
    case SampleFormat::express:
      return next_frame<SampleFormat::express>(bytes, block);
    case SampleFormat::hq:
      return next_frame<SampleFormat::hq>(bytes, block);
    case SampleFormat::ultra:
      return next_frame<SampleFormat::ultra>(bytes, block);
    case SampleFormat::dense:
      return next_frame<SampleFormat::dense>(bytes, block);
    case SampleFormat::ultra_dense:
      return next_frame<SampleFormat::ultra_dense>(bytes, block);
  }
  bytes = {};
  return false;
}

template <SampleFormat format>
bool SampleDecoder::next_frame(std::span<const std::uint8_t>& bytes, SampleBlock& block) {
  constexpr std::size_t frame_bytes = layout_of(format).bytes;
  while (!bytes.empty()) {
    const std::size_t judged = frame_bytes + (in_step_ ? 0 : confirming_sync_bytes(format));
    if (held_size_ > 0) {
      hold(bytes, std::min(bytes.size(), judged - held_size_));
      const std::span<const std::uint8_t> held = std::span(held_).first(held_size_);
      if (!may_begin<format>(held)) {
        drop_false_begin<format>();
      } else if (held_size_ == judged) {
        if (is_frame<format>(held)) {
          const bool complete = accept<format>(held_.data(), block);
          release(frame_bytes);
          if (complete) return true;
        } else {
          drop_false_begin<format>();
        }
      }
      continue;
    }
    if (const std::size_t offset = begin_of_frame<format>(bytes); offset > 0) {
      skip(offset);
      bytes = bytes.subspan(offset);
    } else if (bytes.size() < judged) {
      hold(bytes, bytes.size());
    } else if (is_frame<format>(bytes.first(judged))) {
      // The usual case: a whole frame, which is read where it lies.
      const std::uint8_t* frame = bytes.data();
      bytes = bytes.subspan(frame_bytes);
      if (accept<format>(frame, block)) return true;
    } else {
      skip(1);
      bytes = bytes.subspan(1);
    }
  }
  return false;
}

/// Whether this, which begins as a frame, is one; with what follows it, if that is there.
template <SampleFormat format>
bool SampleDecoder::is_frame(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t size = layout_of(format).bytes;
  if (checksum_is_right<format>(bytes.data())) {
    return bytes.size() == size || may_begin<format>(bytes.subspan(size));
  }
  if (in_step_) ++counts_.checksum_errors;
  return false;
}

/// Goes on to the next index in the held bytes at which a frame may begin: a good one may begin
/// inside what was no frame.
template <SampleFormat format>
void SampleDecoder::drop_false_begin() {
  const std::size_t offset =
      1 + begin_of_frame<format>(std::span(held_).first(held_size_).subspan(1));
  skip(offset);
  release(offset);
}

template <SampleFormat format>
bool SampleDecoder::accept(const std::uint8_t* frame, SampleBlock& block) {
  constexpr FrameLayout layout = layout_of(format);
  ++counts_.frames;
  in_step_ = true;
  if constexpr (format == SampleFormat::hq) {
    decode_hq(frame, block);
    hand_out(block, layout.samples - 1);
    return true;
  } else {
    constexpr std::size_t offset = start_angle_offset(format);
    const auto start_q6 = [](const std::uint8_t* capsule) {
      const std::uint32_t angle = load<std::uint16_t>(capsule + offset) & 0x7FFFu;
      return angle < full_circle_q6 ? angle : angle - full_circle_q6;
    };
    if ((load<std::uint16_t>(frame + offset) & stream_start_bit) != 0) {
      if (counts_.frames > 1) ++counts_.restarts;
      has_previous_ = false;
      after_gap_ = true;
    }
    bool complete = false;
    if (has_previous_) {
      const std::uint32_t begin = start_q6(previous_.data());
      const std::uint32_t end = start_q6(frame);
      const std::uint32_t difference = end - begin + (begin > end ? full_circle_q6 : 0);
      if (difference > largest_difference_q6_) {
        ++counts_.implausible;
        after_gap_ = true;
      } else {
        const CapsuleAngles angles{static_cast<std::int32_t>(begin << 10),
                                   static_cast<std::int32_t>((difference << 10) / layout.samples)};
        if constexpr (format == SampleFormat::express) {
          decode_express(previous_.data(), angles, block);
        } else if constexpr (format == SampleFormat::ultra) {
          decode_ultra(previous_.data(), frame, angles, block);
        } else if constexpr (format == SampleFormat::dense) {
          decode_dense(previous_.data(), angles, block);
        } else {
          if (after_gap_) last_distance_q2_ = 0;
          decode_ultra_dense(previous_.data(), angles, last_distance_q2_, block);
        }
        hand_out(block, 2 * layout.samples - 1);
        complete = true;
      }
    }
    std::memcpy(previous_.data(), frame, layout.bytes);
    has_previous_ = true;
    return complete;
  }
}

bool SampleDecoder::next_nodes(std::span<const std::uint8_t>& bytes, SampleBlock& block) {
  block.size = 0;
  for (;;) {
    if (held_size_ == 0 && in_step_) {
      while (bytes.size() >= node_bytes && block.size < SampleBlock::capacity &&
             fit_nodes(bytes.first(node_bytes))) {
        append_node(bytes.data(), block);
        bytes = bytes.subspan(node_bytes);
      }
      if (block.size > 0) {
        counts_.frames += block.size;
        hand_out(block, block.size - 1);
        return true;
      }
    }
    if (bytes.empty()) return false;
    hold(bytes, 1);
    while (held_size_ > 0 && !fit_nodes(std::span(held_).first(held_size_))) {
      skip(1);
      release(1);
    }
    if (held_size_ == (in_step_ ? node_bytes : confirming_bytes)) {
      in_step_ = true;
      for (std::size_t i = 0; i < held_size_; i += node_bytes) append_node(held_.data() + i, block);
      held_size_ = 0;
    }
  }
}

void SampleDecoder::hand_out(SampleBlock& block, std::size_t age) {
  block.age = age;
  block.after_gap = after_gap_;
  after_gap_ = false;
  counts_.samples += block.size;
}

void SampleDecoder::skip(std::size_t count) {
  counts_.skipped_bytes += count;
  in_step_ = false;
  has_previous_ = false;
  after_gap_ = true;
}

void SampleDecoder::hold(std::span<const std::uint8_t>& bytes, std::size_t count) {
  std::memcpy(held_.data() + held_size_, bytes.data(), count);
  held_size_ += count;
  bytes = bytes.subspan(count);
}

void SampleDecoder::release(std::size_t count) {
  held_size_ -= count;
  std::memmove(held_.data(), held_.data() + count, held_size_);
}

}  // namespace quoin::sensor_bridge::rplidar
