// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as answers of a device and as requests of a client.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "sensor_bridge/rplidar/protocol/configuration.hpp"
#include "sensor_bridge/rplidar/protocol/descriptor.hpp"
#include "sensor_bridge/rplidar/protocol/device_info.hpp"
#include "sensor_bridge/rplidar/protocol/request.hpp"
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"
#include "tests/fuzz/require.hpp"

namespace {

using namespace quoin::sensor_bridge::rplidar;
using quoin::fuzz::require;
using Bytes = std::span<const std::uint8_t>;

void parse_payload(Bytes payload) {
  // Devices may answer with more than is known of.
  const auto begins_with = [&](Bytes known) {
    return known.size() <= payload.size() && std::ranges::equal(known, payload.first(known.size()));
  };
  if (const auto info = parse_info(payload)) {
    require(begins_with(encode(*info)), "device info is written as it was read");
    require(serial_number_text(*info).size() == 32, "a serial number has 32 digits");
    require(!firmware_text(*info).empty() && !model_text(*info).empty(), "names are not empty");
    require(traits_of(*info).usual_baud_rate >= 115200, "each model has a baud rate");
  }
  if (const auto health = parse_health(payload)) {
    require(begins_with(encode(*health)), "health is written as it was read");
  }
  if (const auto times = parse_sample_times(payload)) {
    require(begins_with(encode(*times)), "sample times are written as read");
  }
  for (const ConfigurationKey key : {ConfigurationKey::mode_sample_time,
                                     ConfigurationKey::mode_name, ConfigurationKey::typical_mode}) {
    const auto value = configuration_value(key, payload);
    if (!value) continue;
    require(std::ranges::equal(encode_configuration(key, *value), payload),
            "configuration is written as it was read");
    if (const auto seconds = parse_sample_time(*value)) {
      require(*seconds > 0.0 && *seconds <= 0.1, "sample times are such of a device");
    }
    require(parse_text(*value).size() <= value->size(), "texts do not grow");
    require(parse_number(*value).has_value() ==
                (value->size() == 1 || value->size() == 2 || value->size() == 4),
            "numbers have 1, 2 or 4 bytes");
  }
}

template <class Scanner, class Found>
void scan(Bytes bytes, std::size_t piece, std::vector<Found>& all) {
  Scanner scanner;
  while (!bytes.empty()) {
    Bytes part = bytes.first(std::min(piece, bytes.size()));
    bytes = bytes.subspan(part.size());
    while (const auto found = scanner.next(part)) {
      const auto encoded = [&] {
        if constexpr (requires { found->bytes(); }) {
          const Bytes span = found->bytes();
          return std::vector<std::uint8_t>(span.begin(), span.end());
        } else {
          const auto array = encode(*found);
          return std::vector<std::uint8_t>(array.begin(), array.end());
        }
      }();
      all.push_back(encoded);
    }
    require(part.empty(), "a scanner takes all bytes");
  }
}

/// What a scanner finds lies in the bytes, one behind the other, however these arrive.
template <class Scanner>
void check_scanner(Bytes bytes) {
  std::vector<std::vector<std::uint8_t>> whole;
  std::vector<std::vector<std::uint8_t>> single;
  scan<Scanner>(bytes, bytes.size(), whole);
  scan<Scanner>(bytes, 1, single);
  require(whole == single, "what is found does not depend on how the bytes arrive");
  Bytes rest = bytes;
  for (const std::vector<std::uint8_t>& found : whole) {
    // Bits above the length of a frame are read over.
    constexpr bool has_spare_bits = std::is_same_v<Scanner, DescriptorScanner>;
    const auto is_at = [&](std::size_t place) {
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (has_spare_bits && (i == 4 || i == 5)) continue;
        if (rest[place + i] != found[i]) return false;
      }
      return true;
    };
    std::size_t place = 0;
    while (place + found.size() <= rest.size() && !is_at(place)) ++place;
    require(place + found.size() <= rest.size(), "what is found is there");
    rest = rest.subspan(place + found.size());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes bytes(data, size);
  check_scanner<DescriptorScanner>(bytes);
  check_scanner<RequestScanner>(bytes);
  parse_payload(bytes);
  // A payload behind each descriptor, as a client reads it.
  DescriptorScanner scanner;
  Bytes rest = bytes;
  while (const auto descriptor = scanner.next(rest)) {
    require(descriptor->length > 0 && descriptor->length <= largest_frame_bytes,
            "payloads are short");
    if (descriptor->length <= rest.size()) parse_payload(rest.first(descriptor->length));
  }
  return 0;
}
