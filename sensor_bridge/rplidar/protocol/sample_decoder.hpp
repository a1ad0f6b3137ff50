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
  std::uint64_t checksum_errors = 0;  ///< frames thrown away
  std::uint64_t skipped_bytes = 0;    ///< passed over in search of a frame
  std::uint64_t implausible = 0;      ///< pairs of capsules whose angles cannot follow each other
  std::uint64_t restarts = 0;         ///< capsules that say that the stream began anew
};

/// Turns the bytes behind a descriptor into measurements; finds the frames again after any damage.
/// No input and no output of its own, and no memory but its members.
class SampleDecoder {
 public:
  /// `sample_period` [s] bounds how far two capsules may be apart; 0 when unknown.
  explicit SampleDecoder(SampleFormat format, double sample_period = 0.0);

  /// Takes bytes from the front of `bytes` until a block is complete: true, and the rest of `bytes`
  /// is still to be given. False when all bytes were taken. The block may hold anything then.
  [[nodiscard]] bool next(std::span<const std::uint8_t>& bytes, SampleBlock& block);

  [[nodiscard]] SampleFormat format() const { return format_; }
  [[nodiscard]] const DecoderCounts& counts() const { return counts_; }

 private:
  SampleFormat format_;
  DecoderCounts counts_;
};

}  // namespace quoin::sensor_bridge::rplidar
