// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sensor_bridge/rplidar/protocol/frame_angles.hpp"
#include "sensor_bridge/rplidar/protocol/sample_block.hpp"
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What became of a capsule.
enum class CapsuleFate {
  taken,
  repeated,    ///< it has been there before, and was dropped
  out_of_line  ///< no number of missing capsules explains where it begins
};

/// Makes blocks of capsules with right checksums. A capsule carries the angle of its first sample
/// only; the next capsule shows where it ends. Where the next one is missing, the samples are
/// placed by the speed that is known. Two capsules that have changed places are put right. A
/// capsule that fits neither the one before nor the one behind it is dropped.
class CapsuleSequence {
 public:
  /// Not for HQ capsules, see HqSequence.
  explicit CapsuleSequence(SampleFormat format) : format_(format), layout_(layout_of(format)) {}

  /// Takes a capsule; true when it made a block. Of a doubtful capsule only the angle is used.
  [[nodiscard]] bool add(const std::uint8_t* capsule, bool doubtful, SampleBlock& block,
                         CapsuleFate& fate);
  /// Bytes were dropped or damaged behind the last capsule: it is not read any more.
  void interrupt() { has_previous_ = false; }
  /// The device has started its stream anew.
  void restart();

 private:
  static constexpr std::size_t largest_bytes = layout_of(SampleFormat::ultra_dense).bytes;

  void keep(const std::uint8_t* capsule, std::int32_t begin_q16, std::optional<int> missing,
            bool doubtful);
  void emit(const std::uint8_t* capsule, const std::uint8_t* behind, std::int32_t begin_q16,
            std::int32_t step_q16, SampleBlock& block);
  [[nodiscard]] bool emit_before_jump(const std::uint8_t* capsule, std::int32_t begin_q16,
                                      SampleBlock& block);
  [[nodiscard]] std::int32_t begin_of(const std::uint8_t* capsule) const;

  SampleFormat format_;
  FrameLayout layout_;
  FrameAngles angles_;
  int misfits_ = 0;  // capsules in a row that fit nothing

  // The last capsule, which waits for the next one.
  bool has_previous_ = false;
  bool doubtful_ = false;
  bool jumped_ = false;         // it does not follow the one before it
  std::optional<int> missing_;  // frames before it
  std::int32_t previous_q16_ = 0;
  std::array<std::uint8_t, largest_bytes> previous_{};

  // Behind the last block.
  bool has_expected_ = false;
  std::int32_t expected_q16_ = 0;  // where the next capsule begins
  std::size_t cut_off_ = 0;        // samples of it that could not be read
  std::uint32_t last_distance_q2_ = 0;
};

/// Makes blocks of HQ capsules, which have an angle for each sample: tells how many are missing
/// between two of them, and drops what comes twice or too late.
class HqSequence {
 public:
  [[nodiscard]] bool add(const std::uint8_t* capsule, SampleBlock& block, CapsuleFate& fate);
  void interrupt() { interrupted_ = true; }

 private:
  bool interrupted_ = true;
  bool has_expected_ = false;
  std::int32_t expected_q16_ = 0;
  int misfits_ = 0;  // each counts two, and is forgotten one by one
  std::uint32_t last_checksum_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
