// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/capsule_sequence.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "sensor_bridge/rplidar/protocol/capsule.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr auto circle_q16 = static_cast<std::int32_t>(full_circle_q16);
/// Behind so many capsules that fit nothing the speed is taken anew.
constexpr int most_misfits = 3;

std::int32_t around(std::int32_t angle_q16) {
  return angle_q16 >= circle_q16 ? angle_q16 - circle_q16 : angle_q16;
}

}  // namespace

std::int32_t CapsuleSequence::begin_of(const std::uint8_t* capsule) const {
  constexpr std::uint32_t full_circle_q6 = 360u << 6;
  const std::uint32_t angle = load<std::uint16_t>(capsule + start_angle_offset(format_)) & 0x7FFFu;
  return static_cast<std::int32_t>((angle < full_circle_q6 ? angle : angle - full_circle_q6) << 10);
}

void CapsuleSequence::restart() {
  has_previous_ = false;
  has_expected_ = false;
  cut_off_ = 0;
}

bool CapsuleSequence::add(const std::uint8_t* capsule, bool doubtful, SampleBlock& block,
                          CapsuleFate& fate) {
  fate = CapsuleFate::taken;
  const std::int32_t begin = begin_of(capsule);
  const auto missing_before = [&]() -> std::optional<int> {
    if (!has_expected_) return std::nullopt;
    return angles_.missing_frames(expected_q16_, begin);
  };
  if (!has_previous_) {
    keep(capsule, begin, missing_before(), doubtful);
    jumped_ = has_expected_;
    return false;
  }
  if (std::memcmp(capsule, previous_.data(), layout_.bytes) == 0) {
    fate = CapsuleFate::repeated;
    return false;
  }
  const std::int32_t difference = clockwise_q16(previous_q16_, begin);
  if (angles_.can_follow(difference)) {
    misfits_ = 0;
    angles_.note_step(difference);
    if (doubtful_) {
      keep(capsule, begin, missing_before(), doubtful);
      return false;
    }
    emit(previous_.data(), capsule, previous_q16_, difference, block);
    keep(capsule, begin, 0, doubtful);
    return true;
  }
  fate = CapsuleFate::out_of_line;
  if (angles_.step_q16() == 0 || angles_.step_q16() > circle_q16 / 3) {
    keep(capsule, begin, std::nullopt, doubtful);
    return false;
  }
  if (!angles_.confirmed() && difference < angles_.step_q16()) {
    // The first step was one over a gap.
    angles_.forget();
    angles_.note_step(difference);
    emit(previous_.data(), capsule, previous_q16_, difference, block);
    keep(capsule, begin, 0, doubtful);
    return true;
  }
  const std::optional<int> missing = missing_before();
  const std::int32_t back = clockwise_q16(begin, previous_q16_);
  if (jumped_ && missing == 0 && missing_ && *missing_ > 0) {
    if (angles_.can_follow(back)) {
      // This is the one that was missing before the last one: it fills the hole.
      missing_ = 0;
      jumped_ = false;
      emit(capsule, previous_.data(), begin, back, block);
      return true;
    }
    // The last one came late or twice.
    fate = CapsuleFate::repeated;
    keep(capsule, begin, 0, doubtful);
    return false;
  }
  if (jumped_ && (!missing_ || (missing && *missing < *missing_))) {
    // It fits neither the one before it nor this one, or this one fits the one before it better.
    keep(capsule, begin, missing, doubtful);
    jumped_ = true;
    if (++misfits_ >= most_misfits) angles_.forget();
    return false;
  }
  if (missing) fate = CapsuleFate::taken;  // whole capsules are missing, no more
  if (doubtful_ || doubtful) {
    keep(capsule, begin, missing, doubtful);
    return false;
  }
  return emit_before_jump(capsule, begin, block);
}

/// The capsule behind the last one is missing: its samples are placed by what is known.
bool CapsuleSequence::emit_before_jump(const std::uint8_t* capsule, std::int32_t begin_q16,
                                       SampleBlock& block) {
  const std::int32_t known = angles_.step_q16();
  const std::int32_t difference = clockwise_q16(previous_q16_, begin_q16);
  const std::optional<int> missing =
      angles_.missing_frames(around(previous_q16_ + known), begin_q16);
  std::int32_t step = known;
  int frames = 1;
  constexpr int few = 8;
  if (missing && *missing > 0 && *missing < few) {
    frames = *missing + 1;
    const std::int32_t mean = difference / frames;
    if (std::abs(mean - known) < known / 16) step = mean;
  }
  emit(previous_.data(), nullptr, previous_q16_, step, block);
  block.age += static_cast<std::size_t>(frames - 1) * layout_.samples;
  keep(capsule, begin_q16, missing, false);
  jumped_ = true;
  return true;
}

void CapsuleSequence::keep(const std::uint8_t* capsule, std::int32_t begin_q16,
                           std::optional<int> missing, bool doubtful) {
  std::memcpy(previous_.data(), capsule, layout_.bytes);
  has_previous_ = true;
  previous_q16_ = begin_q16;
  missing_ = missing;
  doubtful_ = doubtful;
  jumped_ = false;
}

void CapsuleSequence::emit(const std::uint8_t* capsule, const std::uint8_t* behind,
                           std::int32_t begin_q16, std::int32_t step_q16, SampleBlock& block) {
  const CapsuleAngles angles{begin_q16, step_q16 / static_cast<std::int32_t>(layout_.samples)};
  const bool follows = has_expected_ && missing_ == 0;
  std::size_t cut_off = 0;
  switch (format_) {
    case SampleFormat::express:
      decode_express(capsule, angles, block);
      break;
    case SampleFormat::ultra:
      decode_ultra(capsule, behind != nullptr ? behind : capsule, angles, block);
      // The last two samples lean on the capsule behind.
      if (behind == nullptr) cut_off = 2;
      block.size -= cut_off;
      break;
    case SampleFormat::ultra_dense:
      if (!follows) last_distance_q2_ = 0;
      decode_ultra_dense(capsule, angles, last_distance_q2_, block);
      break;
    default:
      decode_dense(capsule, angles, block);
      break;
  }
  block.age = 2 * layout_.samples - 1;
  block.after_gap = !follows || cut_off_ > 0;
  block.lost_known = missing_.has_value();
  block.lost_unit = layout_.samples;
  block.lost = cut_off_ + static_cast<std::size_t>(missing_.value_or(0)) * layout_.samples;
  block.samples_per_turn =
      angles_.confirmed() && step_q16 > 0
          ? static_cast<double>(layout_.samples) * full_circle_q16 / angles_.step_q16()
          : 0.0;
  has_expected_ = true;
  expected_q16_ = around(begin_q16 + step_q16);
  cut_off_ = cut_off;
}

bool HqSequence::add(const std::uint8_t* capsule, SampleBlock& block, CapsuleFate& fate) {
  fate = CapsuleFate::taken;
  constexpr FrameLayout layout = layout_of(SampleFormat::hq);
  const auto checksum = load<std::uint32_t>(capsule + layout.bytes - sizeof(std::uint32_t));
  if (has_expected_ && checksum == last_checksum_) {
    fate = CapsuleFate::repeated;
    return false;
  }
  decode_hq(capsule, block);
  std::int32_t span = 0;
  for (std::size_t k = 1; k < block.size; ++k) {
    span += turned_q16(static_cast<std::int32_t>(block.angle_q16[k - 1]),
                       static_cast<std::int32_t>(block.angle_q16[k]));
  }
  const std::int32_t step = span / static_cast<std::int32_t>(block.size - 1);
  const std::int32_t frame = step * static_cast<std::int32_t>(block.size);
  const auto begin = static_cast<std::int32_t>(block.angle_q16[0]);
  // A frame is a large part of a turn: angles decide among few missing ones.
  constexpr int most_missing = 3;
  std::optional<int> missing;
  if (has_expected_ && step > 0) {
    for (int frames = 0; frames <= most_missing && !missing; ++frames) {
      const auto at = static_cast<std::int32_t>(
          (expected_q16_ + static_cast<std::int64_t>(frames) * frame) % circle_q16);
      const std::int32_t tolerance = 3 * step + (frames + 1) * (frame / 64);
      if (std::abs(turned_q16(at, begin)) <= tolerance) missing = frames;
    }
    if (!missing && !interrupted_) {
      misfits_ += 2;
      fate = CapsuleFate::out_of_line;
      if (misfits_ <= most_misfits) return false;
    }
  }
  misfits_ = std::clamp(misfits_ - 1, 0, 2 * most_misfits);
  block.age = layout.samples - 1;
  block.after_gap = interrupted_ || missing != 0;
  // A frame is near to half a turn, so that angles do not tell one missing frame from three.
  block.lost_known = missing == 0 && !interrupted_;
  block.lost_unit = layout.samples;
  block.lost = 0;
  block.samples_per_turn =
      step > 0 && misfits_ < most_misfits ? static_cast<double>(full_circle_q16) / step : 0.0;
  interrupted_ = false;
  has_expected_ = true;
  expected_q16_ =
      around(static_cast<std::int32_t>(block.angle_q16[block.size - 1]) + std::max(step, 0));
  last_checksum_ = checksum;
  return true;
}

}  // namespace quoin::sensor_bridge::rplidar
