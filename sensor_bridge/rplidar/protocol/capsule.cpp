// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/capsule.hpp"

#include "sensor_bridge/rplidar/protocol/distance_scale.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr auto circle = static_cast<std::int32_t>(full_circle_q16);

/// Angles from less than a circle below zero to less than two above.
std::uint32_t wrapped(std::int32_t angle_q16) {
  angle_q16 += angle_q16 < 0 ? circle : 0;
  angle_q16 -= angle_q16 >= circle ? circle : 0;
  return static_cast<std::uint32_t>(angle_q16);
}

/// Few capsules span angle zero; the others need no look at each angle.
template <std::size_t count>
void fill_angles(CapsuleAngles angles, SampleBlock& block) {
  const auto last = static_cast<std::int32_t>(count - 1);
  for (std::int32_t k = 0; k <= last; ++k) {
    block.angle_q16[static_cast<std::size_t>(k)] =
        static_cast<std::uint32_t>(angles.start_q16 + k * angles.step_q16);
  }
  if (angles.start_q16 + last * angles.step_q16 < circle) return;
  for (std::size_t k = 0; k < count; ++k) {
    block.angle_q16[k] = wrapped(static_cast<std::int32_t>(block.angle_q16[k]));
  }
}

template <std::size_t count>
void fill_qualities(SampleBlock& block) {
  for (std::size_t k = 0; k < count; ++k) {
    block.quality[k] = block.distance_q2[k] != 0 ? return_quality : 0;
  }
}

}  // namespace

void decode_express(const std::uint8_t* capsule, CapsuleAngles angles, SampleBlock& block) {
  constexpr std::size_t cabins = 16;
  constexpr std::size_t cabin_bytes = 5;
  block.size = 2 * cabins;
  std::int32_t angle = angles.start_q16;
  for (std::size_t k = 0; k < block.size; k += 2) {
    const std::uint8_t* cabin = capsule + 4 + k / 2 * cabin_bytes;
    const std::uint32_t low_bits = cabin[4];
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t word = load<std::uint16_t>(cabin + 2 * i);
      // Six bits of 1/8 degree that the vendor's manual calls signed and its software does not.
      const std::uint32_t correction_q3 = ((low_bits >> (4 * i)) & 0xF) | ((word & 3) << 4);
      block.distance_q2[k + i] = word & 0xFFFC;
      block.angle_q16[k + i] = wrapped(angle - static_cast<std::int32_t>(correction_q3 << 13));
      angle += angles.step_q16;
    }
  }
  fill_qualities<2 * cabins>(block);
}

void decode_ultra(const std::uint8_t* capsule, const std::uint8_t* behind, CapsuleAngles angles,
                  SampleBlock& block) {
  constexpr std::size_t cabins = 32;
  constexpr std::size_t cabin_bytes = 4;
  block.size = 3 * cabins;
  const auto word_of = [](const std::uint8_t* from, std::size_t cabin) {
    return load<std::uint32_t>(from + 4 + cabin * cabin_bytes);
  };
  const auto predicted_q2 = [](std::uint32_t word, unsigned shift, UltraDistance base) {
    // Ten bits with a sign; the outermost values mean no return.
    const auto prediction = static_cast<std::int32_t>(word << shift) >> 22;
    if (prediction == -512 || prediction == 511) return std::uint32_t{0};
    const std::int32_t distance =
        static_cast<std::int32_t>(base.distance) + prediction * (1 << base.level);
    return distance > 0 ? static_cast<std::uint32_t>(distance) << 2 : 0;
  };
  std::uint32_t word = word_of(capsule, 0);
  UltraDistance major = decode_ultra_distance(word & 0xFFF);
  for (std::size_t cabin = 0; cabin < cabins; ++cabin) {
    const std::uint32_t next_word =
        cabin + 1 < cabins ? word_of(capsule, cabin + 1) : word_of(behind, 0);
    const UltraDistance next = decode_ultra_distance(next_word & 0xFFF);
    const UltraDistance base = major.distance == 0 && next.distance != 0 ? next : major;
    block.distance_q2[3 * cabin] = major.distance << 2;
    block.distance_q2[3 * cabin + 1] = predicted_q2(word, 10, base);
    block.distance_q2[3 * cabin + 2] = predicted_q2(word, 0, next);
    word = next_word;
    major = next;
  }

  // The optics look from beside the axis: near things are seen at another angle. The vendor's
  // software reckons in radians of 16 fraction bits: 7.5 degrees below 50 mm, else 8 less a part
  // that falls with the distance.
  constexpr double degrees = 180.0 / 3.14159265;
  for (std::size_t k = 0; k < block.size; ++k) {
    const std::uint32_t distance_q2 = block.distance_q2[k];
    const auto inverse = distance_q2 == 0 ? 0 : static_cast<std::int32_t>(98361.0 / distance_q2);
    const std::int32_t radians_q16 =
        distance_q2 < 200 ? 8578 : 9150 - inverse * 64 - inverse * inverse * inverse / 98304;
    const auto offset_q16 = static_cast<std::int32_t>(radians_q16 * degrees);
    block.angle_q16[k] =
        wrapped(angles.start_q16 + static_cast<std::int32_t>(k) * angles.step_q16 - offset_q16);
  }
  fill_qualities<3 * cabins>(block);
}

void decode_dense(const std::uint8_t* capsule, CapsuleAngles angles, SampleBlock& block) {
  constexpr std::size_t count = layout_of(SampleFormat::dense).samples;
  block.size = count;
  for (std::size_t k = 0; k < count; ++k) {
    block.distance_q2[k] = std::uint32_t{load<std::uint16_t>(capsule + 4 + 2 * k)} << 2;
  }
  for (std::size_t k = 0; k < count; ++k) {
    block.quality[k] = load<std::uint16_t>(capsule + 4 + 2 * k) != 0 ? return_quality : 0;
  }
  fill_angles<count>(angles, block);
}

void decode_ultra_dense(const std::uint8_t* capsule, CapsuleAngles angles,
                        std::uint32_t& last_distance_q2, SampleBlock& block) {
  constexpr std::size_t cabins = 32;
  constexpr std::size_t cabin_bytes = 5;
  // The vendor's software takes the mean of two near points that are at most 2 mm apart.
  constexpr std::uint32_t same_q2 = 8;
  block.size = 2 * cabins;
  for (std::size_t k = 0; k < block.size; k += 2) {
    const std::uint8_t* cabin = capsule + 10 + k / 2 * cabin_bytes;
    const std::uint32_t high_bits = cabin[4];
    for (std::size_t i = 0; i < 2; ++i) {
      const UltraDensePoint point = decode_ultra_dense_point(load<std::uint16_t>(cabin + 2 * i) |
                                                             ((high_bits >> (4 * i)) & 0xF) << 16);
      std::uint32_t distance_q2 = point.distance_q2;
      if (point.fine && distance_q2 != 0 && last_distance_q2 != 0 &&
          distance_q2 + same_q2 >= last_distance_q2 && last_distance_q2 + same_q2 >= distance_q2) {
        distance_q2 = (distance_q2 + last_distance_q2) / 2;
      }
      last_distance_q2 = distance_q2;
      block.distance_q2[k + i] = distance_q2;
      block.quality[k + i] = point.quality;
    }
  }
  fill_angles<2 * cabins>(angles, block);
}

void decode_hq(const std::uint8_t* capsule, SampleBlock& block) {
  constexpr std::size_t node_bytes = 8;
  block.size = layout_of(SampleFormat::hq).samples;
  for (std::size_t k = 0; k < block.size; ++k) {
    const std::uint8_t* node = capsule + 9 + k * node_bytes;
    // A quarter of a circle has 2^14 steps: 360/65536 degrees each.
    block.angle_q16[k] = std::uint32_t{load<std::uint16_t>(node)} * 360;
    block.distance_q2[k] = load<std::uint32_t>(node + 2);
    block.quality[k] = node[6];
  }
}

}  // namespace quoin::sensor_bridge::rplidar
