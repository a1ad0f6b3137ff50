// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "sensor_bridge/rplidar/protocol/capsule_sequence.hpp"
#include "sensor_bridge/rplidar/protocol/node_sequence.hpp"
#include "sensor_bridge/rplidar/protocol/sample_block.hpp"
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What a decoder has seen since it was made.
struct DecoderCounts {
  std::uint64_t frames = 0;           ///< whole and with a right checksum
  std::uint64_t samples = 0;          ///< handed out
  std::uint64_t checksum_errors = 0;  ///< where a frame was expected; not those met in searching
  std::uint64_t skipped_bytes = 0;    ///< passed over in search of a frame
  std::uint64_t out_of_line =
      0;                       ///< frames that are not where any number of missing ones puts them
  std::uint64_t restarts = 0;  ///< capsules that say that the stream began anew
  std::uint64_t repeated = 0;  ///< capsules that were there before, and were dropped

  friend bool operator==(const DecoderCounts&, const DecoderCounts&) = default;
};

/// Turns the bytes behind a descriptor into measurements; finds the frames again after any damage:
/// what it takes for a frame and is none hides no other one. What the angles of whole frames show
/// is up to CapsuleSequence, HqSequence and NodeSequence. No input and no output of its own, and no
/// memory but its members.
class SampleDecoder {
 public:
  /// The first bytes are taken on trust, as they follow the descriptor.
  explicit SampleDecoder(SampleFormat format) : format_(format), capsules_(format) {}

  /// Takes bytes from the front of `bytes` until a block is complete: true, and the rest of `bytes`
  /// is still to be given. False when all bytes were taken. The block may hold anything then.
  /// Standard nodes that are there at once make one block; each waits for the next one, which
  /// confirms it, and the first ones behind damage for a few.
  [[nodiscard]] bool next(std::span<const std::uint8_t>& bytes, SampleBlock& block);

  [[nodiscard]] SampleFormat format() const { return format_; }
  [[nodiscard]] const DecoderCounts& counts() const { return counts_; }

 private:
  [[nodiscard]] bool next_nodes(std::span<const std::uint8_t>& bytes, SampleBlock& block);
  template <SampleFormat format>
  [[nodiscard]] bool next_frame(std::span<const std::uint8_t>& bytes, SampleBlock& block);
  template <SampleFormat format>
  [[nodiscard]] bool is_frame(std::span<const std::uint8_t> bytes);
  template <SampleFormat format>
  void drop_false_begin();
  template <SampleFormat format>
  [[nodiscard]] bool accept(const std::uint8_t* frame, SampleBlock& block);
  void count_node();
  void skip(std::size_t count);
  void hold(std::span<const std::uint8_t>& bytes, std::size_t count);
  void release(std::size_t count);

  SampleFormat format_;
  bool in_step_ = true;         ///< a frame is expected to begin where the last one ended
  bool behind_damage_ = false;  ///< no frame has been read since
  double damage_ = 0.0;         ///< share of the last frames before which there was damage
  CapsuleSequence capsules_;
  HqSequence hq_capsules_;
  NodeSequence nodes_;
  DecoderCounts counts_;
  std::array<std::uint8_t, largest_frame_bytes> held_{};  ///< what may be the begin of a frame
  std::size_t held_size_ = 0;
  std::size_t confirmed_bytes_ = 0;  ///< of these: nodes to be read
};

}  // namespace quoin::sensor_bridge::rplidar
