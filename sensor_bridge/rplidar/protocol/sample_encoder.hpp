// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

/// A measurement to be sent.
struct Sample {
  std::uint32_t angle_q16 = 0;    ///< [1/65536 deg] clockwise, below full_circle_q16
  std::uint32_t distance_q2 = 0;  ///< [1/4 mm], 0 without a return
  std::uint8_t quality = 0;       ///< 0..255; dense, express and ultra capsules do not carry it
};

/// Lays measurements out as a device does: the other end of SampleDecoder. What a format cannot
/// hold (longer distances, finer steps) is rounded or sent as no return. Express capsules keep
/// single points that lag behind. Readers of ultra capsules correct each angle for a laser 24 mm
/// beside the axis: what is sent with an angle is read at it when it is far.
class SampleEncoder {
 public:
  explicit SampleEncoder(SampleFormat format);

  /// Appends one frame of the next layout_of(format).samples samples, all of them one sample period
  /// apart. The sample behind them may be given as well: the last distance of an ultra capsule
  /// leans on it, and is sent as no return without it. `timestamp_us` is what formats with a time
  /// of their own carry. Throws std::invalid_argument when the number of samples is another.
  void encode(std::span<const Sample> samples, std::uint64_t timestamp_us,
              std::vector<std::uint8_t>& bytes);

 private:
  void encode_hq(std::span<const Sample> samples, std::uint64_t timestamp_us,
                 std::span<std::uint8_t> frame);
  [[nodiscard]] bool starts_revolution(std::uint32_t angle_q16);

  SampleFormat format_;
  bool first_ = true;  ///< marks the start of the stream
  std::uint32_t last_angle_q16_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
