// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace quoin::sensor_bridge {

/// Where a device is attached.
struct Endpoint {
  enum class Kind { serial, tcp, udp };

  Kind kind = Kind::serial;
  std::string path;        ///< of a serial port
  std::string host;        ///< name or address; an IPv6 address without its brackets
  std::uint16_t port = 0;  ///< of the host

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// A text that names no endpoint; what() says why and what would.
class EndpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ports of the vendor's serial servers and of its devices with Ethernet.
inline constexpr std::uint16_t default_tcp_port = 20108;
inline constexpr std::uint16_t default_udp_port = 8089;

/// "/dev/ttyUSB0" (or a link to it; relative with ./ or ../), "tcp://host:port" or
/// "udp://host:port"; the port may be left out, an IPv6 address stands in brackets. Throws
/// EndpointError.
[[nodiscard]] Endpoint parse_endpoint(std::string_view text);

/// What parse_endpoint reads.
[[nodiscard]] std::string to_text(const Endpoint& endpoint);

}  // namespace quoin::sensor_bridge
