// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/link.hpp"

#include <stdexcept>
#include <utility>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/rplidar/emulator/pseudo_terminal.hpp"
#include "sensor_bridge/rplidar/emulator/tcp_server.hpp"
#include "sensor_bridge/rplidar/emulator/udp_server.hpp"

namespace quoin::sensor_bridge::rplidar {

std::unique_ptr<Link> make_link(const EmulatorSettings& settings, Link::Report report) {
  if (settings.connection == "pty") {
    return std::make_unique<PseudoTerminal>(settings.link, std::move(report));
  }
  if (settings.port < 0 || settings.port > 65535) {
    throw std::invalid_argument("port " + std::to_string(settings.port) +
                                " is not between 0 and 65535");
  }
  const SocketAddress address(settings.address, static_cast<std::uint16_t>(settings.port));
  if (settings.connection == "tcp") return std::make_unique<TcpServer>(address, std::move(report));
  if (settings.connection == "udp") return std::make_unique<UdpServer>(address, std::move(report));
  throw std::invalid_argument("unknown connection " + excerpt(settings.connection) +
                              suggestion(settings.connection, {"pty", "tcp", "udp"}));
}

}  // namespace quoin::sensor_bridge::rplidar
