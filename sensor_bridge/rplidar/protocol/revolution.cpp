// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/revolution.hpp"

#include <algorithm>
#include <utility>

#include "sensor_bridge/rplidar/protocol/frame_angles.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr auto turn_q16 = static_cast<std::int64_t>(full_circle_q16);
/// Of the samples in a revolution, while a motor changes its speed.
constexpr double largest_mismatch = 1.5;
/// A mark is at zero, but for the corrections of single angles.
constexpr std::uint32_t largest_mark_angle_q16 = 45u << 16;
/// A mark comes so many samples behind zero at most; one that has not was lost.
constexpr std::size_t latest_mark = 8;

template <class Values>
void append_values(std::vector<typename Values::value_type>& to, const Values& from,
                   std::size_t begin, std::size_t end) {
  to.insert(to.end(), from.begin() + begin, from.begin() + end);
}

}  // namespace

RevolutionAssembler::RevolutionAssembler(double sample_period, double delay)
    : clock_(sample_period, delay) {}

bool RevolutionAssembler::add(const SampleBlock& block, TimePoint arrival, Revolution& revolution) {
  if (block.size == 0) return false;
  const TimePoint first_sample = clock_.first_sample(block, arrival);
  const auto missing = static_cast<double>(clock_.missing());
  lost_samples_ += clock_.missing();
  if (block.turn_begin < block.size) has_marks_ = true;
  if (missing >= block.samples_per_turn) {  // or the speed is not known
    clear();
    started_ = false;
  }
  samples_per_turn_ = block.samples_per_turn;
  std::size_t behind_zero = 0;  // of the missing samples
  bool complete = false;
  std::size_t begin = 0;
  bool cut = false;
  for (std::size_t i = 0; i < block.size; ++i) {
    if (!is_cut_before(block, i) || cut) continue;
    cut = true;
    if (i == 0 && missing > 0.0) {
      // Of a sensor that hardly turns, a turn has more samples than can be counted.
      behind_zero = static_cast<std::size_t>(
          std::min(static_cast<double>(clock_.missing()),
                   block.samples_per_turn * static_cast<double>(block.angle_q16[0]) /
                       static_cast<double>(full_circle_q16)));
    }
    if (started_) {
      if (block.after_gap) ++current_.gaps;
      current_.lost += clock_.missing() - behind_zero;
      append(block, 0, i, first_sample);
      complete =
          this->complete(first_sample + clock_.span(i) - clock_.span(behind_zero), revolution);
    }
    clear();
    started_ = block.samples_per_turn > 0.0;
    begin = i;
    // What is missing here may belong to either side.
    if (block.after_gap && i == 0) {
      current_.gaps = 1;
      current_.lost = behind_zero;
    }
  }
  if (!cut && block.after_gap) {
    ++current_.gaps;
    current_.lost += clock_.missing();
  }
  if (started_) append(block, begin, block.size, first_sample);
  if (current_.angle_q16.size() > largest_revolution) {
    clear();
    started_ = false;
  }
  return complete;
}

/// Whether a turn begins with this sample of the block.
bool RevolutionAssembler::is_cut_before(const SampleBlock& block, std::size_t index) {
  const std::uint32_t angle = block.angle_q16[index];
  const auto last = static_cast<std::int32_t>(std::exchange(last_angle_q16_, angle));
  if (!has_last_angle_) {
    has_last_angle_ = true;
    return false;
  }
  const bool over_gap = index == 0 && block.after_gap;
  const auto to = static_cast<std::int32_t>(angle);
  const bool forward = over_gap && (block.lost > 0 || block.samples_per_turn == 0.0);
  const std::int64_t turned = forward ? clockwise_q16(last, to) : turned_q16(last, to);
  travel_q16_ += turned;
  // Nearer to the last cut it is that one again: a correction, or a mark just before zero.
  const bool due = !started_ || travel_q16_ >= turn_q16 / 2;
  const bool marked =
      index == block.turn_begin &&
      (angle <= largest_mark_angle_q16 || angle >= full_circle_q16 - largest_mark_angle_q16);
  if (marked && due) return true;
  if (unmarked_ > 0) return due && ++unmarked_ > latest_mark;
  const bool passed_zero = turned > 0 && last + turned >= turn_q16;
  if (!passed_zero || !due) return false;
  if (!has_marks_ || over_gap) return true;
  unmarked_ = 1;
  return false;
}

/// True when it was a revolution that can be.
bool RevolutionAssembler::complete(TimePoint end, Revolution& revolution) {
  finish(end);
  const double time = std::chrono::duration<double>(current_.end - current_.begin).count();
  const double samples = static_cast<double>(current_.angle_q16.size() + current_.lost);
  double rotation = time > 0.0 ? 1.0 / time : 0.0;
  // The speed that angles show and the one that times show are the same.
  if (samples < samples_per_turn_ / largest_mismatch ||
      samples > samples_per_turn_ * largest_mismatch) {
    rotation = 1.0 / (samples_per_turn_ * clock_.sample_period());
    if (rotation >= slowest_rotation && rotation <= fastest_rotation) rotation = 0.0;
  }
  if (!(rotation >= slowest_rotation && rotation <= fastest_rotation)) {
    impossible_rotation_ = rotation;
    ++impossible_revolutions_;
    return false;
  }
  impossible_rotation_.reset();
  std::swap(current_, revolution);
  return true;
}

void RevolutionAssembler::append(const SampleBlock& block, std::size_t begin, std::size_t end,
                                 TimePoint first_sample) {
  if (begin == end) return;
  stamps_.push_back({.sample = current_.angle_q16.size(),
                     .time = first_sample + clock_.span(begin),
                     .block = clock_.last_block(),
                     .in_block = begin});
  append_values(current_.angle_q16, block.angle_q16, begin, end);
  append_values(current_.distance_q2, block.distance_q2, begin, end);
  append_values(current_.quality, block.quality, begin, end);
}

/// Fills in the times, with all that is known of the pace by now: an early block corrects those
/// before it, which came late. None may reach into the next one.
void RevolutionAssembler::finish(TimePoint end) {
  const std::size_t size = current_.angle_q16.size();
  Stamp behind{.sample = size, .time = end, .block = {}, .in_block = 0};
  for (std::size_t k = stamps_.size(); k > 0; --k) {
    Stamp& stamp = stamps_[k - 1];
    stamp.time = clock_.time_of(stamp.block, stamp.in_block).value_or(stamp.time);
    stamp.time = std::min(stamp.time, behind.time - clock_.span(behind.sample - stamp.sample));
    behind = stamp;
  }
  current_.begin = stamps_.empty() ? end : stamps_.front().time;
  current_.end = end;
  current_.time_offset.resize(size);
  const double period = clock_.sample_period();
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
  current_.lost = 0;
  travel_q16_ = 0;
  unmarked_ = 0;
  stamps_.clear();
}

}  // namespace quoin::sensor_bridge::rplidar
