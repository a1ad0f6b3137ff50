// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "sensor_bridge/rplidar/protocol/configuration.hpp"

namespace quoin::sensor_bridge::rplidar {

enum class Command : std::uint8_t {
  scan = 0x20,
  force_scan = 0x21,
  stop = 0x25,
  reset = 0x40,
  info = 0x50,
  health = 0x52,
  sample_rate = 0x59,
  express_scan = 0x82,
  hq_scan = 0x83,
  get_configuration = 0x84,
  set_configuration = 0x85,
  confirm_baud_rate = 0x90,
  motor_speed = 0xA8,
  motor_pwm = 0xF0,
  accessory_board = 0xFF,
};

/// What a request begins with.
inline constexpr std::uint8_t request_sync = 0xA5;

/// The bytes of one request: 0xA5, command, and with bit 7 of the command set length, payload and
/// checksum.
class Request {
 public:
  static constexpr std::size_t largest_payload = 255;

  /// Throws std::invalid_argument when the payload is longer than that, or the command has none.
  explicit Request(Command command, std::span<const std::uint8_t> payload = {});

  [[nodiscard]] Command command() const { return static_cast<Command>(bytes_[1]); }
  [[nodiscard]] std::span<const std::uint8_t> payload() const;
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }

 private:
  std::array<std::uint8_t, 4 + largest_payload> bytes_{};
  std::size_t size_ = 0;
};

[[nodiscard]] Request express_scan_request(std::uint8_t mode, std::uint16_t flags = 0);
/// `speed` in revolutions per minute; 0 lets the motor idle.
[[nodiscard]] Request motor_speed_request(std::uint16_t speed);
/// Of an accessory board; 0 stops the motor.
[[nodiscard]] Request motor_pwm_request(std::uint16_t pwm);
/// What the accessory board can do, if there is one.
[[nodiscard]] Request accessory_board_request();
/// `mode` for the entries that each scan mode has of its own.
[[nodiscard]] Request configuration_request(ConfigurationKey key,
                                            std::optional<std::uint16_t> mode = std::nullopt);

/// Such as "get_configuration 0x71 of mode 1".
[[nodiscard]] std::string request_text(const Request& request);

/// Finds requests in what a client sends, as a device does: bytes that cannot be one, unknown
/// commands and requests with a wrong checksum are passed over.
class RequestScanner {
 public:
  /// Takes bytes from the front of `bytes` until a request is complete; nothing when all were
  /// taken. Call it until then, also when no bytes are left: damage may have hidden two requests.
  [[nodiscard]] std::optional<Request> next(std::span<const std::uint8_t>& bytes);

  [[nodiscard]] std::uint64_t checksum_errors() const { return checksum_errors_; }

 private:
  [[nodiscard]] std::optional<Request> take_request();
  void drop(std::size_t count);

  std::array<std::uint8_t, 4 + Request::largest_payload> bytes_{};
  std::size_t size_ = 0;
  std::uint64_t checksum_errors_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
