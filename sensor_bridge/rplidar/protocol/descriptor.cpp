// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/descriptor.hpp"

#include <algorithm>

#include "sensor_bridge/rplidar/protocol/device_info.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::uint8_t sync[2] = {0xA5, 0x5A};
constexpr std::uint32_t repeated_bit = 1u << 30;
constexpr std::uint32_t length_mask = repeated_bit - 1;
/// Of the length of a scan's frames; some devices set bits above.
constexpr std::uint32_t frame_length_mask = 0xFFFF;
constexpr std::size_t most_appended = 32;
/// Answers to get_configuration: a key, and at most as much as a request holds.
constexpr std::uint32_t smallest_configuration = 4;
constexpr std::uint32_t largest_configuration = 255;

bool plausible(const Descriptor& descriptor) {
  if (const std::optional<SampleFormat> format = sample_format(descriptor.type)) {
    return descriptor.repeated &&
           (descriptor.length & frame_length_mask) == layout_of(*format).bytes;
  }
  if (descriptor.repeated) return false;
  // Newer devices may append to what is known.
  const auto holds = [&](std::size_t bytes) {
    return descriptor.length >= bytes && descriptor.length <= bytes + most_appended;
  };
  switch (static_cast<AnswerType>(descriptor.type)) {
    case AnswerType::info:
      return holds(DeviceInfo::bytes);
    case AnswerType::health:
      return holds(DeviceHealth::bytes);
    case AnswerType::sample_rate:
      return holds(SampleTimes::bytes);
    case AnswerType::accessory_board:
      return holds(4);
    case AnswerType::configuration:
      return descriptor.length >= smallest_configuration &&
             descriptor.length <= largest_configuration;
    case AnswerType::set_configuration:
      return descriptor.length == 8;
  }
  return false;
}

std::optional<Descriptor> parse(const std::array<std::uint8_t, Descriptor::bytes>& bytes) {
  const auto word = load<std::uint32_t>(bytes.data() + 2);
  const Descriptor descriptor{word & length_mask, (word & repeated_bit) != 0, bytes[6]};
  if (!plausible(descriptor)) return std::nullopt;
  if (!descriptor.repeated) return descriptor;
  return Descriptor{descriptor.length & frame_length_mask, true, descriptor.type};
}

}  // namespace

std::array<std::uint8_t, Descriptor::bytes> encode(const Descriptor& descriptor) {
  std::array<std::uint8_t, Descriptor::bytes> bytes{sync[0], sync[1]};
  store(bytes.data() + 2,
        (descriptor.length & length_mask) | (descriptor.repeated ? repeated_bit : 0));
  bytes[6] = descriptor.type;
  return bytes;
}

std::optional<Descriptor> DescriptorScanner::next(std::span<const std::uint8_t>& bytes) {
  while (!bytes.empty()) {
    bytes_[size_] = bytes.front();
    ++size_;
    bytes = bytes.subspan(1);
    if (size_ == Descriptor::bytes) {
      if (const std::optional<Descriptor> descriptor = parse(bytes_)) {
        size_ = 0;
        return descriptor;
      }
      drop_first();
    }
    while (size_ > 0 && (bytes_[0] != sync[0] || (size_ > 1 && bytes_[1] != sync[1]))) {
      drop_first();
    }
  }
  return std::nullopt;
}

void DescriptorScanner::drop_first() {
  std::copy(bytes_.begin() + 1, bytes_.begin() + size_, bytes_.begin());
  --size_;
  ++skipped_bytes_;
}

}  // namespace quoin::sensor_bridge::rplidar
