// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/transport.hpp"

#include "sensor_bridge/transport/network.hpp"
#include "sensor_bridge/transport/serial_port.hpp"

namespace quoin::sensor_bridge {

std::unique_ptr<Transport> open_transport(const Endpoint& endpoint, unsigned baud_rate,
                                          std::chrono::milliseconds time_out) {
  switch (endpoint.kind) {
    case Endpoint::Kind::serial:
      return open_serial(endpoint.path, baud_rate);
    case Endpoint::Kind::tcp:
      return connect_tcp(endpoint, time_out);
    case Endpoint::Kind::udp:
      break;
  }
  return connect_udp(endpoint);
}

}  // namespace quoin::sensor_bridge
