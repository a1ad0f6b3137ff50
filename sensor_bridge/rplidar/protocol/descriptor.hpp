// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace quoin::sensor_bridge::rplidar {

/// What announces an answer: its type, its length, and whether frames of that length follow until
/// the device receives a stop request.
struct Descriptor {
  static constexpr std::size_t bytes = 7;

  std::uint32_t length = 0;  ///< [byte] of one payload, below 2^30
  bool repeated = false;
  std::uint8_t type = 0;

  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// Types of single answers; those of measurements are the values of SampleFormat.
enum class AnswerType : std::uint8_t {
  info = 0x04,
  health = 0x06,
  sample_rate = 0x15,
  configuration = 0x20,
  set_configuration = 0x21,
  accessory_board = 0xFF,
};

[[nodiscard]] std::array<std::uint8_t, Descriptor::bytes> encode(const Descriptor& descriptor);

/// Finds the next descriptor in a stream that may begin with anything. One of a kind that the
/// device cannot mean (unknown type, or a length that its type never has) is passed over, so that
/// measurements that look like one are not taken for it.
class DescriptorScanner {
 public:
  /// Takes bytes from the front of `bytes` up to the end of a descriptor; nothing when all were
  /// taken.
  [[nodiscard]] std::optional<Descriptor> next(std::span<const std::uint8_t>& bytes);

  [[nodiscard]] std::uint64_t skipped_bytes() const { return skipped_bytes_; }

 private:
  void drop_first();

  std::array<std::uint8_t, Descriptor::bytes> bytes_{};
  std::size_t size_ = 0;
  std::uint64_t skipped_bytes_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
