// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sensor_bridge/rplidar/protocol/sample_block.hpp"
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Collects standard nodes, which have no checksum: a node is taken when the angle of the next one
/// follows its own. One that follows nothing and is followed by nothing is dropped. Where angles
/// are evenly spaced, as those of devices that time light, they show how many nodes are missing.
class NodeSequence {
 public:
  static constexpr std::size_t node_bytes = layout_of(SampleFormat::standard).bytes;

  /// Takes a node; the one before it may go into the block. False when the block has to be handed
  /// out before, and the node is to be given again; never so with an empty block.
  [[nodiscard]] bool add(const std::uint8_t* node, SampleBlock& block);
  /// Bytes were dropped or damaged. What came last is not trusted.
  void interrupt();

  /// Whether nodes that were found behind damage, one behind the other, can be those of the sensor
  /// so far: false positives are frequent where nothing but two bits of each node is fixed.
  [[nodiscard]] bool can_go_on(std::span<const std::uint8_t> nodes) const;

  /// Nodes that fit no other one, since it was made.
  [[nodiscard]] std::uint64_t out_of_line() const { return out_of_line_; }

  /// Nodes that wait for the next ones.
  [[nodiscard]] std::size_t waiting() const {
    return (has_candidate_ ? 1U : 0U) + (has_stranger_ ? 1U : 0U);
  }

 private:
  using Node = std::array<std::uint8_t, node_bytes>;

  [[nodiscard]] bool regular() const;
  [[nodiscard]] bool follows(std::int32_t from_q16, std::int32_t to_q16) const;
  [[nodiscard]] bool few_are_missing(std::int32_t from_q16, std::int32_t to_q16) const;
  [[nodiscard]] std::size_t missing_between(std::int32_t from_q16, std::int32_t to_q16) const;
  void begin_with(const std::uint8_t* node);
  [[nodiscard]] bool emit(SampleBlock& block);
  void drop_stranger();
  void note_step(std::int32_t to_q16);

  // The last node that was taken.
  bool has_last_ = false;
  std::int32_t last_q16_ = 0;
  // The node that waits for the next one.
  bool has_candidate_ = false;
  bool after_gap_ = true;  // of the candidate
  Node candidate_{};
  // A node behind it that does not follow it.
  bool has_stranger_ = false;
  Node stranger_{};
  int probation_ = 0;  // nodes that are not taken behind a jump
  int strangers_ = 0;  // in a row
  std::uint64_t out_of_line_ = 0;
  int doubt_ = 0;  // grows with each stranger, falls with each good node

  double step_q16_ = 0.0;       // mean from node to node
  double deviation_q16_ = 0.0;  // mean distance from that
  int steps_ = 0;               // that are in the means
};

}  // namespace quoin::sensor_bridge::rplidar
