// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sensor_bridge/rplidar/protocol/sample_block.hpp"

namespace quoin::sensor_bridge::rplidar {

using TimePoint = std::chrono::steady_clock::time_point;

/// When samples were acquired. A sensor measures at an even pace, but its bytes arrive late by what
/// buffers and schedulers please, never early: the pace is the line under all arrivals that lies
/// closest to them. The slope of that line is the true sample period, which may differ by percents
/// from the declared one; the line is drawn through the earliest arrivals of the last 16 s, as in
/// Moon, Skelly, Towsley, "Estimation and removal of clock skew from network delay measurements"
/// (1999). The first arrivals pull it away from the declared period by as much as their lateness
/// lets them know better. Missing samples are counted on.
class AcquisitionClock {
 public:
  /// `sample_period` [s] as the device declares it, positive. `delay` [s]: from the acquisition of
  /// a sample to the arrival of its last byte when nothing holds it up, such as the time on a
  /// serial line.
  AcquisitionClock(double sample_period, double delay);

  /// Acquisition of the first sample of a block that was complete on `arrival`: the best that is
  /// known then. A block that arrives earlier than the pace so far shows that those before it came
  /// late as well; its time may lie before what was said of their last samples.
  [[nodiscard]] TimePoint first_sample(const SampleBlock& block, TimePoint arrival);

  /// Samples that are missing before the last block, whole turns included.
  [[nodiscard]] std::size_t missing() const { return missing_; }

  /// [s] as the arrivals show it; the declared one at first.
  [[nodiscard]] double sample_period() const { return sample_period_ + slope_; }
  /// The same once it has been measured for long enough to be better than the declared one.
  [[nodiscard]] std::optional<double> measured_period() const;

  [[nodiscard]] std::chrono::nanoseconds span(std::size_t samples) const;

  /// The last block, for a better word on its time once more is known.
  struct Mark {
    std::uint64_t line = 0;  ///< on which it lies: behind long gaps there is a new one
    double index = 0.0;      ///< of its first sample
  };
  [[nodiscard]] Mark last_block() const { return last_block_; }
  /// Acquisition of the sample `samples` behind the first one of that block, as far as the line is
  /// still the same; nothing otherwise.
  [[nodiscard]] std::optional<TimePoint> time_of(Mark block, std::size_t samples) const;

 private:
  /// An arrival: how late [s] the sample with this index was there, against the declared pace.
  struct Arrival {
    double index;
    double lateness;
  };

  void begin_anew(TimePoint origin);
  void count_missing(const SampleBlock& block, double lateness_at_age);
  void note(Arrival arrival);
  void count_read(const Arrival& arrival);
  void close_bucket();
  void draw_line();
  [[nodiscard]] double line(double index) const { return offset_ + slope_ * index; }
  [[nodiscard]] double above_line(const Arrival& arrival) const {
    return arrival.lateness - line(arrival.index);
  }

  static constexpr std::size_t most_buckets = 32;

  double sample_period_;
  double delay_;
  bool started_ = false;
  TimePoint origin_;
  double next_index_ = 0.0;  // of the first sample of the next block
  std::size_t missing_ = 0;
  Mark last_block_;

  // The line: lateness over index.
  double slope_ = 0.0;  // [s] for each sample
  double offset_ = 0.0;
  // What is known of the slope without the arrivals.
  double known_slope_ = 0.0;
  double slope_stddev_;

  double mean_lateness_;    // [s] above the line
  double reads_ = 0.0;      // on this line, blocks that arrived together as one
  double last_read_ = 0.0;  // [s]

  // The least late arrival of each of the last pieces of time, the open one behind them.
  std::array<Arrival, most_buckets + 1> buckets_{};
  std::size_t size_ = 0;      // closed ones
  bool open_ = false;         // there is an open one
  double open_begin_ = 0.0;   // [sample] its begin
  double bucket_span_ = 0.0;  // [s]
};

}  // namespace quoin::sensor_bridge::rplidar
