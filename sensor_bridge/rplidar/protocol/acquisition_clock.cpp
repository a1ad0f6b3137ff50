// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/acquisition_clock.hpp"

#include <algorithm>
#include <cmath>

namespace quoin::sensor_bridge::rplidar {
namespace {

using std::chrono::nanoseconds;

/// How far a device's sample period may be from the declared one.
constexpr double largest_error = 0.06;
constexpr double longest_bucket = 0.5;  // [s]
/// [s] of arrivals from which the slope is known better than from the declaration.
constexpr double measured_after = 0.5;
/// How far a sample period is from what is known of it before: from the declared one, and from
/// the measured one behind a gap. Two standard deviations are what devices are known to differ by.
constexpr double declared_stddev = 0.01;
constexpr double measured_stddev = 0.001;
/// [s] by which arrivals are late in the mean, until some have been seen, and how many it counts.
constexpr double usual_lateness = 1e-3;
constexpr double usual_reads = 2.0;
constexpr double most_reads = 256.0;  // over which the mean is taken
/// [s] Blocks that arrive closer to each other are held up by the same.
constexpr double one_read = 1e-3;
/// [s] Less than that may be a late arrival as well.
constexpr double shortest_gap = 5e-3;
/// [s] Behind a longer gap the line is drawn anew, with the slope that is known.
constexpr double longest_gap = 1.0;
/// When even the earliest arrivals of so many buckets are so late [s], the count has slipped.
constexpr std::size_t slipped_buckets = 4;
constexpr double slipped = 1e-3;

nanoseconds in_nanoseconds(double seconds) { return nanoseconds(std::llround(seconds * 1e9)); }

double in_seconds(nanoseconds time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

AcquisitionClock::AcquisitionClock(double sample_period, double delay)
    : sample_period_(sample_period),
      delay_(delay),
      slope_stddev_(declared_stddev * sample_period),
      mean_lateness_(usual_lateness) {}

TimePoint AcquisitionClock::first_sample(const SampleBlock& block, TimePoint arrival) {
  const TimePoint newest = arrival - in_nanoseconds(delay_);
  const auto age = static_cast<double>(block.age);
  missing_ = 0;
  if (!started_) {
    begin_anew(newest - in_nanoseconds(sample_period() * age));
    started_ = true;
  } else {
    const double index = next_index_ + static_cast<double>(block.lost) + age;
    count_missing(block, in_seconds(newest - origin_) - sample_period_ * index - line(index));
    if (block.after_gap && !block.lost_known && block.samples_per_turn == 0.0) {
      begin_anew(newest - in_nanoseconds(sample_period() * age));
    }
  }
  if (static_cast<double>(missing_) * sample_period() > longest_gap) {
    begin_anew(newest - in_nanoseconds(sample_period() * age));
  }
  const double first = next_index_ + (next_index_ > 0.0 ? static_cast<double>(missing_) : 0.0);
  note({.index = first + age,
        .lateness = in_seconds(newest - origin_) - sample_period_ * (first + age)});
  next_index_ = first + static_cast<double>(block.size);
  last_block_.index = first;
  return *time_of(last_block_, 0);
}

std::optional<TimePoint> AcquisitionClock::time_of(Mark block, std::size_t samples) const {
  if (block.line != last_block_.line) return std::nullopt;
  const double index = block.index + static_cast<double>(samples);
  return origin_ + in_nanoseconds(sample_period_ * index + line(index));
}

std::optional<double> AcquisitionClock::measured_period() const {
  if (size_ < 2) return std::nullopt;
  const double span = (buckets_[size_ - 1].index - buckets_[0].index) * sample_period_;
  return span >= measured_after ? std::optional(sample_period()) : std::nullopt;
}

nanoseconds AcquisitionClock::span(std::size_t samples) const {
  return in_nanoseconds(sample_period() * static_cast<double>(samples));
}

/// Keeps the slope.
void AcquisitionClock::begin_anew(TimePoint origin) {
  if (measured_period()) slope_stddev_ = measured_stddev * sample_period_;
  known_slope_ = slope_;
  reads_ = 0.0;
  ++last_block_.line;
  origin_ = origin;
  next_index_ = 0.0;
  offset_ = 0.0;
  size_ = 0;
  open_ = false;
  bucket_span_ = 0.0;
}

/// `late` [s]: how far above the line the block arrives if as many samples are missing as it says.
/// Whole turns, of which angles show nothing, are taken from that.
void AcquisitionClock::count_missing(const SampleBlock& block, double late) {
  missing_ = block.lost;
  if (block.after_gap && !block.lost_known && late > shortest_gap) {
    // The arrival alone tells.
    const double units = late / (sample_period() * static_cast<double>(block.lost_unit));
    missing_ += static_cast<std::size_t>(units + 0.3) * block.lost_unit;
    return;
  }
  if (block.samples_per_turn <= 0.0) return;
  const double turn = block.samples_per_turn * sample_period();
  if (block.after_gap && late > 0.0) {
    // Late by up to nearly a turn is late.
    const double turns = std::floor(late / turn + 0.1);
    missing_ += static_cast<std::size_t>(std::llround(turns * block.samples_per_turn));
  }
  // Earlier than it can be: a whole turn was counted that was not missing, but late.
  if (late < -0.5 * turn) {
    next_index_ -= std::round(std::round(-late / turn) * block.samples_per_turn);
  }
}

void AcquisitionClock::note(Arrival arrival) {
  count_read(arrival);
  const bool opens = !open_;
  if (opens) {
    open_ = true;
    open_begin_ = arrival.index;
    buckets_[size_] = arrival;
  } else if (above_line(arrival) < above_line(buckets_[size_])) {
    buckets_[size_] = arrival;
  } else if ((arrival.index - open_begin_) * sample_period_ < bucket_span_) {
    return;  // nothing new
  }
  draw_line();
  if ((arrival.index - open_begin_) * sample_period_ >= bucket_span_) close_bucket();
}

/// Before the line is drawn with it.
void AcquisitionClock::count_read(const Arrival& arrival) {
  const double time = arrival.lateness + sample_period_ * arrival.index;
  if (reads_ > 0.0 && time - last_read_ < one_read) return;
  last_read_ = time;
  if (reads_ > 0.0) {
    const double weight = 1.0 / (std::min(reads_, most_reads) + usual_reads);
    mean_lateness_ += weight * (std::max(0.0, above_line(arrival)) - mean_lateness_);
  }
  reads_ += 1.0;
}

void AcquisitionClock::close_bucket() {
  open_ = false;
  ++size_;
  if (size_ > 2 * slipped_buckets && bucket_span_ >= longest_bucket) {
    const auto late = [this](std::size_t back) { return above_line(buckets_[size_ - back]); };
    bool all_late = true;
    for (std::size_t back = 1; back <= slipped_buckets; ++back) {
      all_late = all_late && late(back) > slipped;
    }
    if (all_late) {
      std::copy_n(buckets_.begin() + static_cast<std::ptrdiff_t>(size_ - slipped_buckets),
                  slipped_buckets, buckets_.begin());
      size_ = slipped_buckets;
      draw_line();
    }
  }
  if (size_ < most_buckets) return;
  if (bucket_span_ >= longest_bucket) {
    std::copy(buckets_.begin() + 1, buckets_.end(), buckets_.begin());
    --size_;
    return;
  }
  // Twice as long ones: of each two the one that is less late.
  for (std::size_t k = 0; k < size_ / 2; ++k) {
    const Arrival& a = buckets_[2 * k];
    const Arrival& b = buckets_[2 * k + 1];
    buckets_[k] = above_line(a) <= above_line(b) ? a : b;
  }
  size_ /= 2;
  const double span = (buckets_[size_ - 1].index - buckets_[0].index) * sample_period_;
  bucket_span_ =
      std::min(longest_bucket, std::max(2.0 * bucket_span_, span / static_cast<double>(size_)));
}

/// Lateness is taken as exponentially distributed, and the slope as normally distributed around
/// what was known before: the most probable line lies under all arrivals. With many of them it is
/// the one that is closest to them in sum, and follows their lower convex hull where the mean index
/// is; few pull the slope no farther than their lateness in the mean allows.
void AcquisitionClock::draw_line() {
  const std::size_t count = size_ + (open_ ? 1 : 0);
  std::array<std::size_t, most_buckets + 1> hull;
  std::size_t corners = 0;
  double mean = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const Arrival& point = buckets_[k];
    mean += point.index / static_cast<double>(count);
    while (corners >= 2) {
      const Arrival& a = buckets_[hull[corners - 2]];
      const Arrival& b = buckets_[hull[corners - 1]];
      const bool above = (b.lateness - a.lateness) * (point.index - a.index) >=
                         (point.lateness - a.lateness) * (b.index - a.index);
      if (!above) break;
      --corners;
    }
    hull[corners++] = k;
  }
  // The logarithm of the probability, n (offset + slope * mean) / lateness - (slope - known)^2 / 2
  // variance, is concave along the hull: it has its maximum at the first of its points, or between
  // two of them, behind which it falls.
  const double pull = slope_stddev_ * slope_stddev_ * reads_ / mean_lateness_;
  double steepest_before = -largest_error * sample_period_;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    const Arrival& at = buckets_[hull[corner]];
    slope_ = std::max(known_slope_ + pull * (mean - at.index), steepest_before);
    if (corner + 1 == corners) break;
    const Arrival& next = buckets_[hull[corner + 1]];
    steepest_before =
        std::max(steepest_before, (next.lateness - at.lateness) / (next.index - at.index));
    if (slope_ <= steepest_before) break;
  }
  slope_ = std::min(slope_, largest_error * sample_period_);
  offset_ = buckets_[hull[0]].lateness - slope_ * buckets_[hull[0]].index;
  for (std::size_t k = 1; k < count; ++k) {
    offset_ = std::min(offset_, buckets_[k].lateness - slope_ * buckets_[k].index);
  }
}

}  // namespace quoin::sensor_bridge::rplidar
