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
  std::size_t gaps = 0;            ///< gaps in which samples are missing
};

/// When samples were acquired. A sensor measures at an even pace, but its bytes arrive late by what
/// buffers and schedulers please; the earliest arrivals give the pace. Follows a clock that differs
/// from the host's by up to 300 parts per million, and begins anew behind a gap.
class AcquisitionClock {
 public:
  /// `sample_period` [s], positive. `delay` [s]: from the acquisition of a sample to the arrival of
  /// its last byte when nothing holds it up, such as the time on a serial line.
  AcquisitionClock(double sample_period, double delay);

  /// Acquisition of the first sample of a block that was complete on `arrival`: the best that is
  /// known then. A block that arrives earlier than the pace so far shows that those before it came
  /// late as well; its time may lie before what was said of their last samples.
  [[nodiscard]] TimePoint first_sample(const SampleBlock& block, TimePoint arrival);

  [[nodiscard]] std::chrono::nanoseconds span(std::size_t samples) const;

 private:
  double sample_period_;
  double delay_;
  bool started_ = false;
  TimePoint next_;                    ///< where the pace so far puts the next block
  std::chrono::nanoseconds rise_{0};  ///< how far behind that the next block may be put
};

/// Cuts the stream of measurements where the angle passes zero: where it is smaller than the one
/// before by more than half a circle. Steps back over zero, as corrections of single angles make
/// them, are taken back before the next cut. The revolution under way when the stream begins is
/// discarded, and one that takes too many samples, as of a motor that stands still, as well.
class RevolutionAssembler {
 public:
  static constexpr std::size_t largest_revolution = 32768;  ///< [sample]

  /// See AcquisitionClock.
  RevolutionAssembler(double sample_period, double delay);

  /// Takes the block; true when it completed a revolution, which then is in `revolution`, whose
  /// memory is used again. A block spans less than half a revolution. The times of a revolution
  /// rise from sample to sample.
  [[nodiscard]] bool add(const SampleBlock& block, TimePoint arrival, Revolution& revolution);

 private:
  /// When the samples from this one on were acquired.
  struct Stamp {
    std::size_t sample;
    TimePoint time;
  };

  [[nodiscard]] bool passes_zero(std::uint32_t angle_q16, bool after_gap);
  void append(const SampleBlock& block, std::size_t begin, std::size_t end, TimePoint first_sample);
  void finish(TimePoint end);
  void clear();

  AcquisitionClock clock_;
  Revolution current_;
  std::vector<Stamp> stamps_;
  bool started_ = false;
  bool has_last_angle_ = false;
  std::uint32_t last_angle_q16_ = 0;
  std::size_t steps_back_ = 0;  ///< over zero, not yet taken back
};

}  // namespace quoin::sensor_bridge::rplidar
