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
/// As many when they lead elsewhere than the nodes before.
constexpr std::size_t telling_bytes = 8 * node_bytes;
/// Where more than this share of the frames is damaged, a checksum of eight bits lets damaged ones
/// pass: the first frame behind damage is not trusted.
constexpr double heavy_damage = 0.3;

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

}  // namespace

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
  ++counts_.frames;
  in_step_ = true;
  CapsuleFate fate = CapsuleFate::taken;
  bool complete = false;
  if constexpr (format == SampleFormat::hq) {
    complete = hq_capsules_.add(frame, block, fate);
  } else {
    const auto start = load<std::uint16_t>(frame + start_angle_offset(format));
    if ((start & stream_start_bit) != 0) {
      if (counts_.frames > 1) ++counts_.restarts;
      capsules_.restart();
    }
    constexpr double weight = 1.0 / 16.0;
    damage_ += weight * ((behind_damage_ ? 1.0 : 0.0) - damage_);
    complete = capsules_.add(frame, behind_damage_ && damage_ > heavy_damage, block, fate);
    behind_damage_ = false;
  }
  if (fate == CapsuleFate::repeated) ++counts_.repeated;
  if (fate == CapsuleFate::out_of_line) ++counts_.out_of_line;
  if (complete) counts_.samples += block.size;
  return complete;
}

bool SampleDecoder::next_nodes(std::span<const std::uint8_t>& bytes, SampleBlock& block) {
  block.size = 0;
  const auto hand_out = [&] {
    block.age = block.size - 1 + nodes_.waiting();
    counts_.samples += block.size;
    return true;
  };
  for (;;) {
    // Nodes that have confirmed each other behind damage.
    while (confirmed_bytes_ > 0) {
      if (block.size >= SampleBlock::capacity || !nodes_.add(held_.data(), block)) {
        return hand_out();
      }
      count_node();
      release(node_bytes);
      confirmed_bytes_ -= node_bytes;
    }
    if (held_size_ == 0 && in_step_) {
      while (bytes.size() >= node_bytes && fit_nodes(bytes.first(node_bytes))) {
        if (block.size >= SampleBlock::capacity || !nodes_.add(bytes.data(), block)) break;
        count_node();
        bytes = bytes.subspan(node_bytes);
      }
      if (block.size > 0) return hand_out();
    }
    if (bytes.empty()) return block.size > 0 && hand_out();
    hold(bytes, 1);
    while (held_size_ > 0 && !fit_nodes(std::span(held_).first(held_size_))) {
      skip(1);
      release(1);
    }
    if (in_step_ ? held_size_ == node_bytes
                 : held_size_ % node_bytes == 0 && held_size_ >= confirming_bytes &&
                       nodes_.can_go_on(std::span(held_).first(held_size_))) {
      in_step_ = true;
      confirmed_bytes_ = held_size_;
    } else if (held_size_ >= telling_bytes) {
      skip(1);
      release(1);
    }
  }
}

void SampleDecoder::count_node() {
  ++counts_.frames;
  counts_.out_of_line = nodes_.out_of_line();
}

void SampleDecoder::skip(std::size_t count) {
  counts_.skipped_bytes += count;
  in_step_ = false;
  behind_damage_ = true;
  capsules_.interrupt();
  hq_capsules_.interrupt();
  nodes_.interrupt();
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
