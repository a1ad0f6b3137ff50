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
/// [s] of arrivals before which they say less of the slope than what was known before.
constexpr double shortest_span = 0.04;
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
    : sample_period_(sample_period), delay_(delay) {}

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

/// Of all lines under the arrivals the one that is closest to them in sum: it follows the lower
/// convex hull where the mean index is.
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
  const double limit = largest_error * sample_period_;
  for (std::size_t corner = 1; corner < corners; ++corner) {
    const Arrival& a = buckets_[hull[corner - 1]];
    const Arrival& b = buckets_[hull[corner]];
    if (b.index < mean && corner + 1 < corners) continue;
    const double span = (buckets_[count - 1].index - buckets_[0].index) * sample_period_;
    if (b.index > a.index && span >= shortest_span) {
      slope_ = std::clamp((b.lateness - a.lateness) / (b.index - a.index), -limit, limit);
    }
    break;
  }
  offset_ = buckets_[hull[0]].lateness - slope_ * buckets_[hull[0]].index;
  for (std::size_t k = 1; k < count; ++k) {
    offset_ = std::min(offset_, buckets_[k].lateness - slope_ * buckets_[k].index);
  }
}

}  // namespace quoin::sensor_bridge::rplidar
