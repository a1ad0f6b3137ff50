// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/transmitter.hpp"

#include <algorithm>

#include "sensor_bridge/rplidar/emulator/seconds.hpp"

namespace quoin::sensor_bridge::rplidar {

Transmitter::Transmitter(std::int64_t baud_rate)
    : byte_time_(10.0 / static_cast<double>(baud_rate)) {
  bytes_.reserve(2 * capacity);
}

void Transmitter::push(std::span<const std::uint8_t> bytes, TimePoint now) {
  // What has left the transmitter but was not fetched yet takes no room.
  std::size_t waiting = 0;
  for (auto piece = pieces_.rbegin(); piece != pieces_.rend() && piece->sent > now; ++piece) {
    waiting += piece->size;
  }
  if (bytes.empty()) return;
  if (waiting + bytes.size() > capacity) {
    lost_bytes_ += bytes.size();
    return;
  }
  free_at_ = std::max(free_at_, now) + duration_of(byte_time_ * static_cast<double>(bytes.size()));
  pieces_.push_back({free_at_, bytes.size()});
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

void Transmitter::pop(TimePoint now, std::vector<std::uint8_t>& out) {
  std::size_t count = 0;
  while (!pieces_.empty() && pieces_.front().sent <= now) {
    count += pieces_.front().size;
    pieces_.pop_front();
  }
  const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(first_);
  out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  first_ += count;
  if (pieces_.empty()) {
    bytes_.clear();
    first_ = 0;
  } else if (first_ >= capacity) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
}

std::optional<Transmitter::TimePoint> Transmitter::next() const {
  if (pieces_.empty()) return std::nullopt;
  return pieces_.front().sent;
}

void Transmitter::clear() {
  pieces_.clear();
  bytes_.clear();
  first_ = 0;
  free_at_ = {};
}

}  // namespace quoin::sensor_bridge::rplidar
