// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sensor_bridge/rplidar/protocol/sample_block.hpp"

namespace quoin::sensor_bridge::rplidar {

using TimePoint = std::chrono::steady_clock::time_point;

/// All measurements from one passing of angle zero to the next, in the order of acquisition.
struct Revolution {
  TimePoint begin;  ///< acquisition of the first sample
  TimePoint end;    ///< acquisition of the first sample of the next revolution
  std::vector<std::uint32_t> angle_q16;
  std::vector<std::uint32_t> distance_q2;
  std::vector<std::uint8_t> quality;
  std::vector<float> time_offset;  ///< [s] acquisition of each sample after `begin`
  std::size_t gaps = 0;            ///< places at which samples are missing
};

/// When samples were acquired. A sensor measures at an even pace, but its bytes arrive late by what
/// buffers and schedulers please; the earliest arrivals tell the pace. Follows a clock that differs
/// from the host's by up to 300 parts per million.
class AcquisitionClock {
 public:
  /// `sample_period` [s], positive. `delay` [s]: from the acquisition of a sample to the arrival of
  /// its last byte when nothing holds it up, such as the time on a serial line.
  AcquisitionClock(double sample_period, double delay);

  /// Acquisition of the first sample of a block that was complete on `arrival`.
  [[nodiscard]] TimePoint first_sample(const SampleBlock& block, TimePoint arrival);

 private:
  double sample_period_;
  double delay_;
};

/// Cuts the stream of measurements where the angle passes zero: where it is smaller than the one
/// before by more than half a circle. The revolution under way when the stream begins is discarded.
class RevolutionAssembler {
 public:
  RevolutionAssembler(double sample_period, double delay);

  /// Takes the block; true when it completed a revolution, which then is in `revolution`, whose
  /// memory is used again. A block spans less than half a revolution.
  [[nodiscard]] bool add(const SampleBlock& block, TimePoint arrival, Revolution& revolution);

 private:
  AcquisitionClock clock_;
  Revolution current_;
  bool started_ = false;
};

}  // namespace quoin::sensor_bridge::rplidar
