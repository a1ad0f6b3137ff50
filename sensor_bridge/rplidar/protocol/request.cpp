// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/request.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "sensor_bridge/rplidar/protocol/checksum.hpp"
#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::size_t header_bytes = 3;  // sync, command, length

bool has_payload(std::uint8_t command) { return (command & 0x80) != 0; }

bool is_command(std::uint8_t command) {
  switch (static_cast<Command>(command)) {
    case Command::scan:
    case Command::force_scan:
    case Command::stop:
    case Command::reset:
    case Command::info:
    case Command::health:
    case Command::sample_rate:
    case Command::express_scan:
    case Command::hq_scan:
    case Command::get_configuration:
    case Command::set_configuration:
    case Command::confirm_baud_rate:
    case Command::motor_speed:
    case Command::motor_pwm:
    case Command::accessory_board:
      return true;
  }
  return false;
}

std::string command_name(Command command) {
  switch (command) {
    case Command::scan:
      return "scan";
    case Command::force_scan:
      return "force_scan";
    case Command::stop:
      return "stop";
    case Command::reset:
      return "reset";
    case Command::info:
      return "info";
    case Command::health:
      return "health";
    case Command::sample_rate:
      return "sample_rate";
    case Command::express_scan:
      return "express_scan";
    case Command::hq_scan:
      return "hq_scan";
    case Command::get_configuration:
      return "get_configuration";
    case Command::set_configuration:
      return "set_configuration";
    case Command::confirm_baud_rate:
      return "confirm_baud_rate";
    case Command::motor_speed:
      return "motor_speed";
    case Command::motor_pwm:
      return "motor_pwm";
    case Command::accessory_board:
      return "accessory_board";
  }
  char unknown[32];
  std::snprintf(unknown, sizeof unknown, "unknown command 0x%02X", static_cast<unsigned>(command));
  return unknown;
}

}  // namespace

Request::Request(Command command, std::span<const std::uint8_t> payload) {
  bytes_[0] = request_sync;
  bytes_[1] = static_cast<std::uint8_t>(command);
  size_ = 2;
  if (!has_payload(bytes_[1])) {
    if (!payload.empty()) {
      throw std::invalid_argument("RPLIDAR command " + std::to_string(bytes_[1]) +
                                  " has no payload; commands from 128 on have one");
    }
    return;
  }
  if (payload.size() > largest_payload) {
    throw std::invalid_argument("the payload of an RPLIDAR request has " +
                                std::to_string(payload.size()) + " bytes; at most 255 fit");
  }
  bytes_[2] = static_cast<std::uint8_t>(payload.size());
  std::ranges::copy(payload, bytes_.begin() + header_bytes);
  size_ = header_bytes + payload.size();
  bytes_[size_] = xor_checksum(bytes());
  ++size_;
}

std::span<const std::uint8_t> Request::payload() const {
  if (size_ <= header_bytes) return {};
  return {bytes_.data() + header_bytes, size_ - header_bytes - 1};
}

Request express_scan_request(std::uint8_t mode, std::uint16_t flags) {
  std::array<std::uint8_t, 5> payload{mode};
  store(payload.data() + 1, flags);
  return Request(Command::express_scan, payload);
}

Request motor_speed_request(std::uint16_t speed) {
  std::array<std::uint8_t, 2> payload{};
  store(payload.data(), speed);
  return Request(Command::motor_speed, payload);
}

Request motor_pwm_request(std::uint16_t pwm) {
  std::array<std::uint8_t, 2> payload{};
  store(payload.data(), pwm);
  return Request(Command::motor_pwm, payload);
}

Request accessory_board_request() {
  return Request(Command::accessory_board, std::array<std::uint8_t, 4>{});
}

Request configuration_request(ConfigurationKey key, std::optional<std::uint16_t> mode) {
  std::array<std::uint8_t, 6> payload{};
  store(payload.data(), static_cast<std::uint32_t>(key));
  store(payload.data() + 4, mode.value_or(0));
  return Request(Command::get_configuration, std::span(payload).first(mode ? 6 : 4));
}

std::string request_text(const Request& request) {
  std::string result = command_name(request.command());
  const std::span<const std::uint8_t> payload = request.payload();
  char detail[48] = "";
  if (request.command() == Command::express_scan && !payload.empty()) {
    std::snprintf(detail, sizeof detail, " in mode %u", unsigned{payload[0]});
  } else if (request.command() == Command::motor_speed && payload.size() == 2) {
    std::snprintf(detail, sizeof detail, " %u rev/min", payload[0] | payload[1] << 8U);
  } else if (request.command() == Command::motor_pwm && payload.size() == 2) {
    std::snprintf(detail, sizeof detail, " %u", payload[0] | payload[1] << 8U);
  } else if (request.command() == Command::get_configuration ||
             request.command() == Command::set_configuration) {
    if (payload.size() >= sizeof(std::uint32_t)) {
      const auto key = load<std::uint32_t>(payload.data());
      std::snprintf(detail, sizeof detail, " 0x%02X", key);
      if (payload.size() == 6) {
        std::snprintf(detail, sizeof detail, " 0x%02X of mode %u", key,
                      payload[4] | payload[5] << 8U);
      }
    }
  }
  return result + detail;
}

std::optional<Request> RequestScanner::next(std::span<const std::uint8_t>& bytes) {
  for (;;) {
    if (const std::optional<Request> request = take_request()) return request;
    if (bytes.empty()) return std::nullopt;
    bytes_[size_] = bytes.front();
    ++size_;
    bytes = bytes.subspan(1);
  }
}

std::optional<Request> RequestScanner::take_request() {
  while (size_ > 0) {
    if (bytes_[0] != request_sync || (size_ > 1 && !is_command(bytes_[1]))) {
      drop(1);
      continue;
    }
    if (size_ < 2) return std::nullopt;
    const auto command = static_cast<Command>(bytes_[1]);
    if (!has_payload(bytes_[1])) {
      drop(2);
      return Request(command);
    }
    if (size_ < header_bytes) return std::nullopt;
    const std::size_t payload_end = header_bytes + bytes_[2];
    if (size_ <= payload_end) return std::nullopt;
    if (xor_checksum(std::span(bytes_).first(payload_end + 1)) != 0) {
      // A good request may begin inside a damaged one.
      ++checksum_errors_;
      drop(1);
      continue;
    }
    const Request request(command, std::span(bytes_).subspan(header_bytes, bytes_[2]));
    drop(payload_end + 1);
    return request;
  }
  return std::nullopt;
}

void RequestScanner::drop(std::size_t count) {
  std::copy(bytes_.begin() + count, bytes_.begin() + size_, bytes_.begin());
  size_ -= count;
}

}  // namespace quoin::sensor_bridge::rplidar
