// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "sensor_bridge/rplidar/protocol/sample_block.hpp"
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What express, ultra, dense and ultra-dense capsules have in common: four bits of sync and four
/// of checksum in each of the first two bytes, and somewhere the angle at which they begin.
inline constexpr std::size_t capsule_sync_bytes = 2;
inline constexpr std::uint16_t stream_start_bit = 0x8000;

/// Where the start angle lies in a capsule of this format.
[[nodiscard]] constexpr std::size_t start_angle_offset(SampleFormat format) {
  return format == SampleFormat::ultra_dense ? 8 : 2;
}

/// The quality that the vendor's software gives to each return of formats that carry none.
inline constexpr std::uint8_t return_quality = 47 << 2;

/// Where the points of a capsule lie.
struct CapsuleAngles {
  std::int32_t start_q16 = 0;  ///< [1/65536 deg], 0 up to below full_circle_q16
  std::int32_t step_q16 = 0;   ///< from point to point; all points span half a circle at most
};

// Each of these fills the angles, distances and qualities of a block. The capsules were checked.

void decode_express(const std::uint8_t* capsule, CapsuleAngles angles, SampleBlock& block);
/// The last point leans on the first one of the capsule behind.
void decode_ultra(const std::uint8_t* capsule, const std::uint8_t* behind, CapsuleAngles angles,
                  SampleBlock& block);
void decode_dense(const std::uint8_t* capsule, CapsuleAngles angles, SampleBlock& block);
/// Near distances are smoothed: `last_distance_q2` is the distance before the first point, 0 when
/// there is none, and becomes that of the last point.
void decode_ultra_dense(const std::uint8_t* capsule, CapsuleAngles angles,
                        std::uint32_t& last_distance_q2, SampleBlock& block);
/// An HQ capsule has an angle for each point.
void decode_hq(const std::uint8_t* capsule, SampleBlock& block);

}  // namespace quoin::sensor_bridge::rplidar
