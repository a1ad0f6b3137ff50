// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/sample_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sensor_bridge/rplidar/protocol/capsule.hpp"
#include "sensor_bridge/rplidar/protocol/checksum.hpp"
#include "sensor_bridge/rplidar/protocol/distance_scale.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"
#include "sensor_bridge/rplidar/protocol/sample_block.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::uint32_t circle_q6 = 360u << 6;
/// Ultra capsules are read with their angles turned back by 8 degrees, for far distances.
constexpr std::uint32_t ultra_offset_q16 = 8u << 16;

std::uint32_t angle_q6(std::uint32_t angle_q16) { return ((angle_q16 + 512) >> 10) % circle_q6; }

/// Whole millimetres, or 0 where `largest` is exceeded.
std::uint32_t millimetres(std::uint32_t distance_q2, std::uint32_t largest) {
  const std::uint32_t rounded = distance_q2 / 4 + (distance_q2 % 4 >= 2 ? 1 : 0);
  return rounded <= largest ? rounded : 0;
}

void encode_node(const Sample& sample, bool revolution_starts, std::uint8_t* frame) {
  frame[0] = static_cast<std::uint8_t>((sample.quality & 0xFC) | (revolution_starts ? 1 : 2));
  store(frame + 1, static_cast<std::uint16_t>(angle_q6(sample.angle_q16) << 1 | 1));
  store(frame + 3,
        static_cast<std::uint16_t>(sample.distance_q2 <= 0xFFFF ? sample.distance_q2 : 0));
}

void encode_express(std::span<const Sample> samples, std::uint8_t* frame) {
  // Readers put the points at even steps and subtract what each one is short of its step.
  const std::uint32_t span =
      (samples.back().angle_q16 + full_circle_q16 - samples.front().angle_q16) % full_circle_q16;
  const double step = static_cast<double>(span) / static_cast<double>(samples.size() - 1);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::uint32_t distance = millimetres(samples[k].distance_q2, 0x3FFF);
    const double behind = static_cast<double>(
        (samples[k].angle_q16 + full_circle_q16 - samples.front().angle_q16) % full_circle_q16);
    const auto correction_q3 = static_cast<std::uint32_t>(
        std::clamp(std::round((static_cast<double>(k) * step - behind) / 8192.0), 0.0, 63.0));
    std::uint8_t* cabin = frame + 4 + k / 2 * 5;
    store(cabin + k % 2 * 2, static_cast<std::uint16_t>(distance << 2 | correction_q3 >> 4));
    cabin[4] |= static_cast<std::uint8_t>((correction_q3 & 0xF) << k % 2 * 4);
  }
}

void encode_ultra(std::span<const Sample> samples, std::uint8_t* frame) {
  constexpr std::uint32_t no_return = 0x200;  // -512
  const auto prediction = [](const Sample& sample, UltraDistance base) {
    const std::uint32_t distance = millimetres(sample.distance_q2, 0xFFFF);
    if (distance == 0) return no_return;
    const double steps = std::round(
        (static_cast<double>(distance) - static_cast<double>(base.distance)) / (1u << base.level));
    if (steps < -511.0 || steps > 510.0) return no_return;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(steps)) & 0x3FF;
  };
  constexpr std::size_t count = layout_of(SampleFormat::ultra).samples;
  std::uint32_t code = encode_ultra_distance(samples[0].distance_q2);
  for (std::size_t k = 0; k < count; k += 3) {
    const bool next_known = k + 3 < samples.size();
    const std::uint32_t next_code =
        next_known ? encode_ultra_distance(samples[k + 3].distance_q2) : 0;
    const UltraDistance major = decode_ultra_distance(code);
    const UltraDistance next = decode_ultra_distance(next_code);
    const bool lean_on_next = major.distance == 0 && next.distance != 0;
    const std::uint32_t first = major.distance == 0 && !next_known
                                    ? no_return
                                    : prediction(samples[k + 1], lean_on_next ? next : major);
    const std::uint32_t second = next_known ? prediction(samples[k + 2], next) : no_return;
    store(frame + 4 + k / 3 * 4, code | first << 12 | second << 22);
    code = next_code;
  }
}

void encode_dense(std::span<const Sample> samples, std::uint8_t* frame) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    store(frame + 4 + 2 * k,
          static_cast<std::uint16_t>(millimetres(samples[k].distance_q2, 0xFFFF)));
  }
}

void encode_ultra_dense(std::span<const Sample> samples, std::uint64_t timestamp_us,
                        std::uint8_t* frame) {
  store(frame + 2, static_cast<std::uint32_t>(timestamp_us));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::uint32_t word = encode_ultra_dense_point(samples[k].distance_q2, samples[k].quality);
    std::uint8_t* cabin = frame + 10 + k / 2 * 5;
    store(cabin + k % 2 * 2, static_cast<std::uint16_t>(word));
    cabin[4] |= static_cast<std::uint8_t>((word >> 16) << k % 2 * 4);
  }
}

void seal_capsule(SampleFormat format, std::uint32_t start_q6, bool first,
                  std::span<std::uint8_t> frame) {
  store(frame.data() + start_angle_offset(format),
        static_cast<std::uint16_t>(start_q6 | (first ? stream_start_bit : 0)));
  const std::uint8_t sum = xor_checksum(frame.subspan(capsule_sync_bytes));
  frame[0] = static_cast<std::uint8_t>(0xA0 | (sum & 0xF));
  frame[1] = static_cast<std::uint8_t>(0x50 | sum >> 4);
}

}  // namespace

SampleEncoder::SampleEncoder(SampleFormat format) : format_(format) {}

void SampleEncoder::encode(std::span<const Sample> samples, std::uint64_t timestamp_us,
                           std::vector<std::uint8_t>& bytes) {
  const FrameLayout layout = layout_of(format_);
  if (samples.size() != layout.samples && samples.size() != layout.samples + 1) {
    throw std::invalid_argument("a frame of format " + format_name(format_) + " holds " +
                                std::to_string(layout.samples) + " samples, not " +
                                std::to_string(samples.size()));
  }
  bytes.resize(bytes.size() + layout.bytes);
  const std::span<std::uint8_t> frame = std::span(bytes).last(layout.bytes);
  const std::span<const Sample> own = samples.first(layout.samples);
  const std::uint32_t start = own.front().angle_q16;
  switch (format_) {
    case SampleFormat::standard:
      encode_node(own.front(), starts_revolution(start), frame.data());
      break;
    case SampleFormat::express:
      encode_express(own, frame.data());
      seal_capsule(format_, angle_q6(start), first_, frame);
      break;
    case SampleFormat::hq:
      encode_hq(own, timestamp_us, frame);
      break;
    case SampleFormat::ultra:
      encode_ultra(samples, frame.data());
      seal_capsule(format_, angle_q6(start + ultra_offset_q16), first_, frame);
      break;
    case SampleFormat::dense:
      encode_dense(own, frame.data());
      seal_capsule(format_, angle_q6(start), first_, frame);
      break;
    case SampleFormat::ultra_dense:
      encode_ultra_dense(own, timestamp_us, frame.data());
      seal_capsule(format_, angle_q6(start), first_, frame);
      break;
  }
  first_ = false;
}

void SampleEncoder::encode_hq(std::span<const Sample> samples, std::uint64_t timestamp_us,
                              std::span<std::uint8_t> frame) {
  frame[0] = 0xA5;
  store(frame.data() + 1, timestamp_us);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    std::uint8_t* node = frame.data() + 9 + 8 * k;
    store(node, static_cast<std::uint16_t>((samples[k].angle_q16 + 180) / 360));
    store(node + 2, samples[k].distance_q2);
    node[6] = samples[k].quality;
    node[7] = starts_revolution(samples[k].angle_q16) ? 1 : 0;
  }
  const std::size_t content = frame.size() - sizeof(std::uint32_t);
  store(frame.data() + content, padded_crc32(frame.first(content)));
}

bool SampleEncoder::starts_revolution(std::uint32_t angle_q16) {
  const bool starts = angle_q16 < last_angle_q16_;
  last_angle_q16_ = angle_q16;
  return starts;
}

}  // namespace quoin::sensor_bridge::rplidar
