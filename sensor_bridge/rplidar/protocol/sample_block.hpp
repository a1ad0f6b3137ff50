// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace quoin::sensor_bridge::rplidar {

/// One revolution in the unit of sample angles.
inline constexpr std::uint32_t full_circle_q16 = 360u << 16;

/// Measurements of one or a few frames, in the order of acquisition. Angles are clockwise from the
/// device's front, as the device counts them.
struct SampleBlock {
  static constexpr std::size_t capacity = 96;

  std::size_t size = 0;
  std::array<std::uint32_t, capacity> angle_q16;    ///< [1/65536 deg], below full_circle_q16
  std::array<std::uint32_t, capacity> distance_q2;  ///< [1/4 mm], 0 without a return
  std::array<std::uint8_t, capacity> quality;       ///< 0..255, as the vendor's software scales it
  /// Sample periods from the acquisition of the first sample to that of the last sample whose bytes
  /// had arrived when the block was complete. Capsules are decoded when the next one is there: 79
  /// for a dense block of 40.
  std::size_t age = 0;
  /// Samples are missing before this block: it is the first one, bytes were dropped or damaged, a
  /// frame has not arrived, or the device has started anew.
  bool after_gap = false;
  /// How many are missing, as the angles show it: less whole turns, of which they show nothing.
  std::size_t lost = 0;
  bool lost_known = false;    ///< the angles do show it
  std::size_t lost_unit = 1;  ///< samples that get lost together: those of a frame
  /// From the angles of frames that agree with each other; 0 while there are none.
  double samples_per_turn = 0.0;
  /// Index of the sample that the device marks as the first one of a turn. Standard nodes only.
  std::size_t turn_begin = capacity;
};

}  // namespace quoin::sensor_bridge::rplidar
