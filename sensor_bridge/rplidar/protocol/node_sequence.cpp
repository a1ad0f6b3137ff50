// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/node_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "sensor_bridge/rplidar/protocol/frame_angles.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

/// Triangulating devices correct each angle for its distance, near ones by up to 8 degrees.
constexpr std::int32_t largest_correction_q16 = 12 << 16;
constexpr int enough_steps = 32;
constexpr double standing = 65536.0 / 100.0;  // [1/65536 deg] from node to node
/// Nodes in a row that fit nothing, behind which all is begun anew.
constexpr int most_strangers = 4;
/// Where nodes that fit nothing are more than a fifth, the stream is not that of one sensor.
constexpr int cost_of_stranger = 4;
constexpr int largest_doubt = 24;
constexpr int nodes_on_probation = 3;
/// As many nodes in a row are no accident, wherever they lead.
constexpr std::size_t telling_nodes = 8;

std::int32_t angle_of(const std::uint8_t* node) {
  constexpr std::uint32_t full_circle_q6 = 360u << 6;
  const std::uint32_t angle_q6 = load<std::uint16_t>(node + 1) >> 1;
  return static_cast<std::int32_t>(angle_q6 == full_circle_q6 ? 0 : angle_q6 << 10);
}

bool marks_turn(const std::uint8_t* node) { return (node[0] & 1) != 0; }

}  // namespace

bool NodeSequence::add(const std::uint8_t* node, SampleBlock& block) {
  if (!has_candidate_) {
    begin_with(node);
    return true;
  }
  const std::int32_t candidate = angle_of(candidate_.data());
  const std::int32_t angle = angle_of(node);
  if (follows(candidate, angle)) {
    if (probation_ > 0) {
      --probation_;
      begin_with(node);
      return true;
    }
    if (!emit(block)) return false;
    if (has_stranger_) drop_stranger();
    begin_with(node);
    after_gap_ = false;
    strangers_ = 0;
    return true;
  }
  if (!has_stranger_) {
    std::memcpy(stranger_.data(), node, node_bytes);
    has_stranger_ = true;
    return true;
  }
  const std::int32_t strange = angle_of(stranger_.data());
  if (follows(strange, angle) && !(regular() && few_are_missing(candidate, strange))) {
    // Many nodes are missing, or what looks like nodes is none: a few more are to show it.
    probation_ = nodes_on_probation;
    begin_with(node);
    return true;
  }
  if (regular() && probation_ == 0 && few_are_missing(candidate, strange) &&
      (follows(strange, angle) || few_are_missing(strange, angle))) {
    // Nodes are missing before the stranger, and perhaps behind it.
    if (!emit(block)) return false;
    const Node stranger = stranger_;
    begin_with(stranger.data());
    return add(node, block);
  }
  if (regular() && probation_ == 0 && few_are_missing(candidate, angle)) {
    // The stranger is a damaged node.
    if (!emit(block)) return false;
    drop_stranger();
    begin_with(node);
    return true;
  }
  drop_stranger();
  std::memcpy(stranger_.data(), node, node_bytes);
  has_stranger_ = true;
  if (++strangers_ >= most_strangers) {
    interrupt();
    has_last_ = false;
    steps_ = 0;
    step_q16_ = 0.0;
    deviation_q16_ = 0.0;
  }
  return true;
}

void NodeSequence::interrupt() {
  has_candidate_ = false;
  has_stranger_ = false;
  after_gap_ = true;
  probation_ = 0;
}

bool NodeSequence::can_go_on(std::span<const std::uint8_t> nodes) const {
  std::int32_t turned = 0;
  for (std::size_t at = node_bytes; at + node_bytes <= nodes.size(); at += node_bytes) {
    const std::int32_t from = angle_of(nodes.data() + at - node_bytes);
    const std::int32_t to = angle_of(nodes.data() + at);
    if (!follows(from, to)) return false;
    turned += turned_q16(from, to);
  }
  if (nodes.size() >= telling_nodes * node_bytes) return turned >= 0;
  if (!has_last_) return false;
  const std::int32_t gap = turned_q16(last_q16_, angle_of(nodes.data()));
  return gap > -largest_correction_q16 && gap <= 2 * largest_correction_q16;
}

bool NodeSequence::regular() const {
  return steps_ >= enough_steps && step_q16_ > standing && deviation_q16_ < 0.15 * step_q16_;
}

bool NodeSequence::follows(std::int32_t from_q16, std::int32_t to_q16) const {
  const std::int32_t turned = turned_q16(from_q16, to_q16);
  if (!regular()) return std::abs(turned) <= largest_correction_q16;
  return turned >= 0.5 * step_q16_ && turned <= 1.5 * step_q16_;
}

bool NodeSequence::few_are_missing(std::int32_t from_q16, std::int32_t to_q16) const {
  const double steps = turned_q16(from_q16, to_q16) / step_q16_;
  return steps > 1.5 && steps < 4.5 && std::abs(steps - std::round(steps)) < 0.3;
}

std::size_t NodeSequence::missing_between(std::int32_t from_q16, std::int32_t to_q16) const {
  const double steps = clockwise_q16(from_q16, to_q16) / step_q16_;
  return steps < 1.5 ? 0 : static_cast<std::size_t>(std::llround(steps)) - 1;
}

void NodeSequence::begin_with(const std::uint8_t* node) {
  std::memcpy(candidate_.data(), node, node_bytes);
  has_candidate_ = true;
  has_stranger_ = false;
  after_gap_ = true;
}

/// Puts the candidate into the block.
bool NodeSequence::emit(SampleBlock& block) {
  const std::int32_t angle = angle_of(candidate_.data());
  if (block.size > 0 &&
      (after_gap_ || (marks_turn(candidate_.data()) && block.turn_begin < SampleBlock::capacity))) {
    return false;
  }
  if (has_last_ && !after_gap_) note_step(angle);
  if (block.size == 0) {
    block.after_gap = after_gap_;
    block.lost_known = after_gap_ && has_last_ && steps_ >= enough_steps && step_q16_ > standing;
    block.lost = block.lost_known ? missing_between(last_q16_, angle) : 0;
    block.lost_unit = 1;
    block.turn_begin = SampleBlock::capacity;
    // Back a little, as corrections of single angles make it.
    if (static_cast<double>(block.lost + 12) * step_q16_ >= full_circle_q16) block.lost = 0;
  }
  block.samples_per_turn = steps_ >= enough_steps && step_q16_ > 0.0 && doubt_ < largest_doubt
                               ? full_circle_q16 / step_q16_
                               : 0.0;
  if (marks_turn(candidate_.data())) block.turn_begin = block.size;
  block.angle_q16[block.size] = static_cast<std::uint32_t>(angle);
  block.distance_q2[block.size] = load<std::uint16_t>(candidate_.data() + 3);
  block.quality[block.size] = candidate_[0] & 0xFC;
  ++block.size;
  doubt_ = std::max(doubt_ - 1, 0);
  has_last_ = true;
  last_q16_ = angle;
  return true;
}

void NodeSequence::drop_stranger() {
  ++out_of_line_;
  doubt_ = std::min(doubt_ + cost_of_stranger, 2 * largest_doubt);
  has_stranger_ = false;
}

void NodeSequence::note_step(std::int32_t to_q16) {
  const double step = turned_q16(last_q16_, to_q16);
  steps_ = std::min(steps_ + 1, enough_steps);
  const double weight = 1.0 / steps_;
  deviation_q16_ += weight * (std::abs(step - step_q16_) - deviation_q16_);
  step_q16_ += weight * (step - step_q16_);
}

}  // namespace quoin::sensor_bridge::rplidar
