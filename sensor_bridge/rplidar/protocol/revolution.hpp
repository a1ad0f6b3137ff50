// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sensor_bridge/rplidar/protocol/acquisition_clock.hpp"
#include "sensor_bridge/rplidar/protocol/sample_block.hpp"

namespace quoin::sensor_bridge::rplidar {

/// All measurements from one passing of angle zero to the next, in the order of acquisition.
struct Revolution {
  TimePoint begin;  ///< acquisition of the first sample
  TimePoint end;    ///< the same of the next revolution, or when it was due where that is missing
  std::vector<std::uint32_t> angle_q16;
  std::vector<std::uint32_t> distance_q2;
  std::vector<std::uint8_t> quality;
  std::vector<float> time_offset;  ///< [s] acquisition of each sample after `begin`
  std::size_t gaps = 0;            ///< gaps in which samples are missing
  std::size_t lost = 0;            ///< samples that are missing in them
};

/// Cuts the stream of measurements where the angle passes zero, or where the device marks the first
/// sample of a turn near there. Steps back over zero, as corrections of single angles make them,
/// cut nothing. Discarded are the revolution under way when the stream begins or is interrupted for
/// a turn, those that take too many samples, as of a motor that stands still, and those of a speed
/// at which no device turns.
class RevolutionAssembler {
 public:
  static constexpr std::size_t largest_revolution = 32768;  ///< [sample]

  /// See AcquisitionClock.
  RevolutionAssembler(double sample_period, double delay);

  /// Takes the block; true when it completed a revolution, which then is in `revolution`, whose
  /// memory is used again. A block spans less than half a revolution. The times of a revolution
  /// rise from sample to sample.
  [[nodiscard]] bool add(const SampleBlock& block, TimePoint arrival, Revolution& revolution);

  [[nodiscard]] const AcquisitionClock& clock() const { return clock_; }
  /// Samples that were missing since the first block, in revolutions or between them.
  [[nodiscard]] std::uint64_t lost_samples() const { return lost_samples_; }
  /// [rev/s] of the last revolutions that were discarded for their speed, until there is a good
  /// one.
  [[nodiscard]] std::optional<double> impossible_rotation() const { return impossible_rotation_; }
  [[nodiscard]] std::uint64_t impossible_revolutions() const { return impossible_revolutions_; }

 private:
  /// When the samples from this one on were acquired.
  struct Stamp {
    std::size_t sample;
    TimePoint time;
    AcquisitionClock::Mark block;
    std::size_t in_block;
  };

  [[nodiscard]] bool is_cut_before(const SampleBlock& block, std::size_t index);
  [[nodiscard]] bool complete(TimePoint end, Revolution& revolution);
  void append(const SampleBlock& block, std::size_t begin, std::size_t end, TimePoint first_sample);
  void finish(TimePoint end);
  void clear();

  AcquisitionClock clock_;
  Revolution current_;
  std::vector<Stamp> stamps_;
  bool started_ = false;
  bool has_last_angle_ = false;
  std::uint32_t last_angle_q16_ = 0;
  double samples_per_turn_ = 0.0;
  std::int64_t travel_q16_ = 0;  // since the last cut
  bool has_marks_ = false;       // the device marks where turns begin
  std::size_t unmarked_ = 0;     // samples since zero was passed without a mark; 0: it was not
  std::uint64_t lost_samples_ = 0;
  std::optional<double> impossible_rotation_;
  std::uint64_t impossible_revolutions_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
