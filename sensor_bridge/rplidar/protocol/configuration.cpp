// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/configuration.hpp"

#include <algorithm>

#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::size_t key_bytes = sizeof(std::uint32_t);

}  // namespace

std::optional<std::span<const std::uint8_t>> configuration_value(
    ConfigurationKey key, std::span<const std::uint8_t> payload) {
  if (payload.size() < key_bytes) return std::nullopt;
  if (load<std::uint32_t>(payload.data()) != static_cast<std::uint32_t>(key)) return std::nullopt;
  return payload.subspan(key_bytes);
}

std::optional<std::uint32_t> parse_number(std::span<const std::uint8_t> value) {
  switch (value.size()) {
    case 1:
      return value[0];
    case 2:
      return load<std::uint16_t>(value.data());
    case 4:
      return load<std::uint32_t>(value.data());
    default:
      return std::nullopt;
  }
}

std::optional<double> parse_sample_time(std::span<const std::uint8_t> value) {
  if (value.size() != sizeof(std::uint32_t)) return std::nullopt;
  const double seconds = load<std::uint32_t>(value.data()) / 256e6;
  if (seconds <= 0.0 || seconds > 0.1) return std::nullopt;
  return seconds;
}

std::string parse_text(std::span<const std::uint8_t> value) {
  std::string text;
  for (const std::uint8_t byte : value) {
    if (byte == 0) break;
    text += byte >= 0x20 && byte < 0x7F ? static_cast<char>(byte) : '?';
  }
  return text;
}

std::vector<std::uint8_t> encode_configuration(ConfigurationKey key,
                                               std::span<const std::uint8_t> value) {
  std::vector<std::uint8_t> payload(key_bytes + value.size());
  store(payload.data(), static_cast<std::uint32_t>(key));
  std::ranges::copy(value, payload.begin() + key_bytes);
  return payload;
}

}  // namespace quoin::sensor_bridge::rplidar
