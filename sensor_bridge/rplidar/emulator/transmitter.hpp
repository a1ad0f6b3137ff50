// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace quoin::sensor_bridge::rplidar {

/// A transmitter that sends 10 bits a byte, one byte after the other, whether a client listens or
/// not. What it is given faster than it can send piles up to a limit.
class Transmitter {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  static constexpr std::size_t capacity = 4096;  ///< [byte] waiting to be sent

  explicit Transmitter(std::int64_t baud_rate);

  /// Bytes to be sent from `now` on, all of them or, when there is no room, none. Calls are in the
  /// order of time.
  void push(std::span<const std::uint8_t> bytes, TimePoint now);

  /// Appends what has been sent until `now`, in whole pushed pieces.
  void pop(TimePoint now, std::vector<std::uint8_t>& out);

  /// When the next piece has been sent.
  [[nodiscard]] std::optional<TimePoint> next() const;

  /// Forgets what waits.
  void clear();

  [[nodiscard]] std::uint64_t lost_bytes() const { return lost_bytes_; }

 private:
  struct Piece {
    TimePoint sent;
    std::size_t size;
  };

  double byte_time_;  // [s]
  TimePoint free_at_{};
  std::deque<Piece> pieces_;
  std::vector<std::uint8_t> bytes_;  // of all pieces
  std::size_t first_ = 0;            // in bytes_, of the first piece
  std::uint64_t lost_bytes_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
