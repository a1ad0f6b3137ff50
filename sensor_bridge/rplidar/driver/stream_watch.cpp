// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/stream_watch.hpp"

#include <cmath>

namespace quoin::sensor_bridge::rplidar {
namespace {

/// Less than that in a window says nothing of the rest; an ultra-dense frame has 170.
constexpr std::uint64_t telling_bytes = 400;

constexpr std::uint64_t telling_frames = 8;

}  // namespace

StreamWatch::StreamWatch(const TimeOuts& time_outs, TimePoint start) : time_outs_(time_outs) {
  last_frame_.time = start;
  window_.time = start;
}

std::optional<Finding> StreamWatch::judge(TimePoint now, const DecoderCounts& counts,
                                          std::uint64_t bytes) {
  const Mark mark{.time = now,
                  .frames = counts.frames,
                  .bytes = bytes,
                  .skipped_bytes = counts.skipped_bytes,
                  .checksum_errors = counts.checksum_errors,
                  .out_of_line = counts.out_of_line};
  if (mark.frames > last_frame_.frames) {
    last_frame_ = mark;
    if (!first_frame_) first_frame_ = now;
  }
  if (now - window_.time >= time_outs_.window) {
    if (const auto finding = judge_window(mark)) return finding;
  }
  if (now - last_frame_.time >= (first_frame_ ? time_outs_.silence : time_outs_.spin_up)) {
    return bytes > last_frame_.bytes ? Finding::no_frames : Finding::silence;
  }
  if (first_frame_) {
    const bool turning = last_revolution_.has_value();
    const TimePoint since = turning ? *last_revolution_ : *first_frame_;
    if (now - since >= (turning ? time_outs_.revolution : time_outs_.spin_up)) {
      return Finding::no_revolution;
    }
  }
  return std::nullopt;
}

std::optional<Finding> StreamWatch::judge_window(const Mark& now) {
  const std::uint64_t bytes = now.bytes - window_.bytes;
  const std::uint64_t skipped = now.skipped_bytes - window_.skipped_bytes;
  const bool damaged = now.checksum_errors > window_.checksum_errors;
  const std::uint64_t frames = now.frames - window_.frames;
  const std::uint64_t out_of_line = now.out_of_line - window_.out_of_line;
  window_ = now;
  // A motor that begins to turn is out of line as well, but not for long.
  if (frames >= telling_frames && 4 * out_of_line > frames) return Finding::mixed_frames;
  if (bytes < telling_bytes || 2 * skipped <= bytes) return std::nullopt;
  return damaged ? Finding::damaged_frames : Finding::no_frames;
}

bool StreamWatch::stable(TimePoint now) const {
  return first_frame_ && last_revolution_ && now - *first_frame_ >= time_outs_.stable;
}

std::optional<double> RotationWatch::note(const Revolution& revolution) {
  const double period = std::chrono::duration<double>(revolution.end - revolution.begin).count();
  if (speed_ <= 0.0 || period <= 0.0) return std::nullopt;
  const double measured = 60.0 / period;
  if (std::abs(measured - speed_) <= tolerance * speed_) {
    was_right_ = true;
    wrong_ = 0;
    return std::nullopt;
  }
  if (!was_right_ && revolution.end < spun_up_) return std::nullopt;
  ++wrong_;
  if (wrong_ != enough) return std::nullopt;
  return measured;
}

}  // namespace quoin::sensor_bridge::rplidar
