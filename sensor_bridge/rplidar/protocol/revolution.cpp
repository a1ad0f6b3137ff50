// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/revolution.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quoin::sensor_bridge::rplidar {
namespace {

using std::chrono::nanoseconds;

/// How much slower than declared a device may measure: two quartz clocks and the rounding of the
/// declared period.
constexpr double largest_drift = 300e-6;

constexpr std::uint32_t half_circle_q16 = full_circle_q16 / 2;

template <class Values>
void append_values(std::vector<typename Values::value_type>& to, const Values& from,
                   std::size_t begin, std::size_t end) {
  to.insert(to.end(), from.begin() + begin, from.begin() + end);
}

}  // namespace

AcquisitionClock::AcquisitionClock(double sample_period, double delay)
    : sample_period_(sample_period), delay_(delay) {}

TimePoint AcquisitionClock::first_sample(const SampleBlock& block, TimePoint arrival) {
  const TimePoint measured = arrival - span(block.age) - nanoseconds(std::llround(delay_ * 1e9));
  TimePoint first = measured;
  if (started_ && !block.after_gap) first = std::min(measured, next_ + rise_);
  started_ = true;
  next_ = first + span(block.size);
  rise_ = nanoseconds(std::llround(static_cast<double>(span(block.size).count()) * largest_drift));
  return first;
}

nanoseconds AcquisitionClock::span(std::size_t samples) const {
  return nanoseconds(std::llround(sample_period_ * 1e9 * static_cast<double>(samples)));
}

RevolutionAssembler::RevolutionAssembler(double sample_period, double delay)
    : clock_(sample_period, delay) {}

bool RevolutionAssembler::add(const SampleBlock& block, TimePoint arrival, Revolution& revolution) {
  if (block.size == 0) return false;
  const TimePoint first_sample = clock_.first_sample(block, arrival);
  if (block.after_gap) ++current_.gaps;
  bool cut = false;
  bool complete = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < block.size; ++i) {
    const bool after_gap = block.after_gap && i == 0;
    if (!passes_zero(block.angle_q16[i], after_gap) || cut) continue;
    cut = true;
    if (started_) {
      append(block, 0, i, first_sample);
      finish(first_sample + clock_.span(i));
      std::swap(current_, revolution);
      complete = true;
    }
    clear();
    started_ = true;
    begin = i;
    // What is missing here may belong to either side.
    if (after_gap) current_.gaps = 1;
  }
  if (started_) append(block, begin, block.size, first_sample);
  if (current_.angle_q16.size() > largest_revolution) {
    clear();
    started_ = false;
  }
  return complete;
}

bool RevolutionAssembler::passes_zero(std::uint32_t angle_q16, bool after_gap) {
  const std::uint32_t last = last_angle_q16_;
  last_angle_q16_ = angle_q16;
  if (!has_last_angle_) {
    has_last_angle_ = true;
    return false;
  }
  if (after_gap) {
    // Any part of a circle may be missing.
    steps_back_ = 0;
    return angle_q16 < last;
  }
  if (last > angle_q16 + half_circle_q16) {
    if (steps_back_ == 0) return true;
    --steps_back_;
  } else if (angle_q16 > last + half_circle_q16) {
    ++steps_back_;
  }
  return false;
}

void RevolutionAssembler::append(const SampleBlock& block, std::size_t begin, std::size_t end,
                                 TimePoint first_sample) {
  if (begin == end) return;
  stamps_.push_back({current_.angle_q16.size(), first_sample + clock_.span(begin)});
  append_values(current_.angle_q16, block.angle_q16, begin, end);
  append_values(current_.distance_q2, block.distance_q2, begin, end);
  append_values(current_.quality, block.quality, begin, end);
}

/// Fills in the times. An early block corrects those before it, which came late: none may reach
/// into the next one.
void RevolutionAssembler::finish(TimePoint end) {
  const std::size_t size = current_.angle_q16.size();
  Stamp behind{size, end};
  for (std::size_t k = stamps_.size(); k > 0; --k) {
    Stamp& stamp = stamps_[k - 1];
    stamp.time = std::min(stamp.time, behind.time - clock_.span(behind.sample - stamp.sample));
    behind = stamp;
  }
  current_.begin = stamps_.empty() ? end : stamps_.front().time;
  current_.end = end;
  current_.time_offset.resize(size);
  const double period = std::chrono::duration<double>(clock_.span(1)).count();
  for (std::size_t k = 0; k < stamps_.size(); ++k) {
    const std::size_t last = k + 1 < stamps_.size() ? stamps_[k + 1].sample : size;
    const double offset = std::chrono::duration<double>(stamps_[k].time - current_.begin).count();
    for (std::size_t i = stamps_[k].sample; i < last; ++i) {
      current_.time_offset[i] =
          static_cast<float>(offset + static_cast<double>(i - stamps_[k].sample) * period);
    }
  }
}

void RevolutionAssembler::clear() {
  current_.angle_q16.clear();
  current_.distance_q2.clear();
  current_.quality.clear();
  current_.time_offset.clear();
  current_.gaps = 0;
  stamps_.clear();
}

}  // namespace quoin::sensor_bridge::rplidar
