// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/reply_reading.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "sensor_bridge/rplidar/protocol/configuration.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

/// The length of an answer of that type, where there is one at all.
std::optional<std::uint32_t> length_of_answer(AnswerType type,
                                              std::span<const std::uint8_t> heard) {
  constexpr std::array<std::uint8_t, 2> sync{0xA5, 0x5A};
  for (auto bytes = heard; bytes.size() >= Descriptor::bytes; bytes = bytes.subspan(1)) {
    if (std::ranges::equal(bytes.first(2), sync) && bytes[6] == static_cast<std::uint8_t>(type)) {
      return load<std::uint32_t>(bytes.data() + 2) & 0x3FFFFFFFu;
    }
  }
  return std::nullopt;
}

}  // namespace

bool answers(const Request& request, std::span<const std::uint8_t> payload) {
  if (request.command() != Command::get_configuration) return true;
  const auto key = load<std::uint32_t>(request.payload().data());
  return configuration_value(static_cast<ConfigurationKey>(key), payload).has_value();
}

Diagnosis diagnose_reply(const Request& request, AnswerType type,
                         std::span<const std::uint8_t> heard, bool spoke_before) {
  const std::string question = request_text(request);
  if (heard.empty() && spoke_before) {
    return {.finding = Finding::no_answer,
            .text = "no answer to " + question + " in time, though bytes have arrived before",
            .advice = "check the cable; a device that takes longer needs a longer answer_timeout"};
  }
  if (heard.empty()) {
    return {
        .finding = Finding::no_bytes,
        .text = "no answer to " + question + ", not a byte arrives",
        .advice = "check the device's power and the cable, also that TX and RX are not swapped"};
  }
  const std::size_t sent = request.bytes().size();
  if (heard.size() >= sent && std::ranges::equal(heard.first(sent), request.bytes())) {
    return {.finding = Finding::echo,
            .text = "what is sent comes back: " + hexadecimal(heard),
            .advice = "this is a loopback or a console, not an RPLIDAR: name another port"};
  }
  if (const auto length = length_of_answer(type, heard)) {
    return {.finding = Finding::wrong_length,
            .text = "an answer to " + question + " that is announced with " +
                    std::to_string(*length) + " bytes is of a wrong length or incomplete",
            .advice = "check the cable, and that the device is an RPLIDAR"};
  }
  return {.finding = Finding::garbage,
          .text = "bytes arrive that are no answer to " + question + ": " + hexadecimal(heard),
          .advice = "the baud rate is another, or this is not an RPLIDAR"};
}

Diagnosis wrong_value(const std::string& name, const std::string& value) {
  return {.finding = Finding::wrong_value,
          .text = name + ": the device says " + value + ", which cannot be",
          .advice = "check the cable, or switch the device off and on"};
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t most = 12;
  constexpr char digits[] = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : bytes.first(std::min(most, bytes.size()))) {
    if (!text.empty()) text += ' ';
    text += digits[byte >> 4];
    text += digits[byte & 0xF];
  }
  return bytes.size() > most ? text + " ..." : text;
}

}  // namespace quoin::sensor_bridge::rplidar
