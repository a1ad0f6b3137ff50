// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "sensor_bridge/rplidar/protocol/sample_block.hpp"
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What a decoder has seen since it was made.
struct DecoderCounts {
  std::uint64_t frames = 0;           ///< whole and with a right checksum
  std::uint64_t samples = 0;          ///< handed out
  std::uint64_t checksum_errors = 0;  ///< where a frame was expected; not those met in searching
  std::uint64_t skipped_bytes = 0;    ///< passed over in search of a frame
  std::uint64_t implausible = 0;      ///< pairs of capsules whose angles cannot follow each other
  std::uint64_t restarts = 0;         ///< capsules that say that the stream began anew

  friend bool operator==(const DecoderCounts&, const DecoderCounts&) = default;
};

/// Turns the bytes behind a descriptor into measurements; finds the frames again after any damage:
/// what it takes for a frame and is none hides no other one. Capsules are read with the one behind
/// them, which shows where they end, and never across a gap. No input and no output of its own, and
/// no memory but its members.
class SampleDecoder {
 public:
  /// `sample_period` [s] bounds how far two capsules may be apart; 0 when unknown.
  /// The first bytes are taken on trust, as they follow the descriptor.
  explicit SampleDecoder(SampleFormat format, double sample_period = 0.0);

  /// Takes bytes from the front of `bytes` until a block is complete: true, and the rest of `bytes`
  /// is still to be given. False when all bytes were taken. The block may hold anything then.
  /// Standard nodes that are there at once make one block; none waits for another, but for the
  /// first three behind damage, which confirm each other.
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
  void skip(std::size_t count);
  void hold(std::span<const std::uint8_t>& bytes, std::size_t count);
  void release(std::size_t count);
  void hand_out(SampleBlock& block, std::size_t age);

  SampleFormat format_;
  std::uint32_t largest_difference_q6_;  ///< between the start angles of two capsules
  bool in_step_ = true;                  ///< a frame is expected to begin where the last one ended
  bool after_gap_ = true;                ///< of the next block
  bool has_previous_ = false;
  std::uint32_t last_distance_q2_ = 0;  ///< for the smoothing of ultra-dense capsules
  DecoderCounts counts_;
  /// The last capsule, which waits for the next one.
  std::array<std::uint8_t, layout_of(SampleFormat::ultra_dense).bytes> previous_{};
  std::array<std::uint8_t, largest_frame_bytes> held_{};  ///< what may be the begin of a frame
  std::size_t held_size_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
