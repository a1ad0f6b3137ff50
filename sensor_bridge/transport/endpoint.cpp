// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/endpoint.hpp"

#include <algorithm>
#include <optional>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge {
namespace {

[[noreturn]] void refuse(std::string_view text, const std::string& reason) {
  throw EndpointError("endpoint " + excerpt(text) + ": " + reason +
                      "; write a serial port such as /dev/ttyUSB0, tcp://192.168.0.7:20108 or "
                      "udp://192.168.11.2:8089");
}

bool stands_in_a_path(char c) { return c > ' ' && c != '\x7F'; }

bool stands_in_a_host(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
         c == '-' || c == '_';
}

bool stands_in_an_address(char c) { return stands_in_a_host(c) || c == ':' || c == '%'; }

/// Takes the host, and the brackets of an IPv6 address, from the front of `rest`.
std::string take_host(std::string_view text, std::string_view& rest) {
  const bool bracketed = rest.starts_with('[');
  const std::size_t end = bracketed ? rest.find(']') : rest.find(':');
  if (bracketed && end == std::string_view::npos) refuse(text, "']' is missing");
  const std::string_view host = bracketed ? rest.substr(1, end - 1) : rest.substr(0, end);
  if (host.empty()) refuse(text, "no host");
  if (!std::ranges::all_of(host, bracketed ? stands_in_an_address : stands_in_a_host)) {
    refuse(text, excerpt(host) + " is no host name or address");
  }
  rest.remove_prefix(
      std::min(rest.size(), end == std::string_view::npos ? end : end + (bracketed ? 1 : 0)));
  return std::string(host);
}

Endpoint parse_network(std::string_view text, std::string_view rest, Endpoint::Kind kind,
                       std::uint16_t default_port) {
  Endpoint endpoint{.kind = kind, .path = {}, .host = take_host(text, rest), .port = default_port};
  if (rest.empty()) return endpoint;
  if (!rest.starts_with(':')) refuse(text, excerpt(rest) + " after the host");
  rest.remove_prefix(1);
  if (rest.find(':') != std::string_view::npos) {
    refuse(text, "an IPv6 address stands in brackets, as in tcp://[::1]:20108");
  }
  const std::optional<std::uint16_t> port = parse_number<std::uint16_t>(rest);
  if (!port || *port == 0) refuse(text, "port " + excerpt(rest) + " is not within 1..65535");
  endpoint.port = *port;
  return endpoint;
}

}  // namespace

Endpoint parse_endpoint(std::string_view text) {
  constexpr std::string_view tcp = "tcp://";
  constexpr std::string_view udp = "udp://";
  if (text.starts_with(tcp)) {
    return parse_network(text, text.substr(tcp.size()), Endpoint::Kind::tcp, default_tcp_port);
  }
  if (text.starts_with(udp)) {
    return parse_network(text, text.substr(udp.size()), Endpoint::Kind::udp, default_udp_port);
  }
  const bool is_path = text.starts_with('/') || text.starts_with("./") || text.starts_with("../");
  if (!is_path) refuse(text, text.empty() ? "it is empty" : "of no known kind");
  if (!std::ranges::all_of(text, stands_in_a_path)) refuse(text, "a space or control character");
  return {.kind = Endpoint::Kind::serial, .path = std::string(text), .host = {}, .port = 0};
}

std::string to_text(const Endpoint& endpoint) {
  if (endpoint.kind == Endpoint::Kind::serial) return endpoint.path;
  const bool bracketed = endpoint.host.find(':') != std::string::npos;
  return (endpoint.kind == Endpoint::Kind::tcp ? "tcp://" : "udp://") +
         (bracketed ? "[" + endpoint.host + "]" : endpoint.host) + ":" +
         std::to_string(endpoint.port);
}

}  // namespace quoin::sensor_bridge
