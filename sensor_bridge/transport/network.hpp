// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>

#include "sensor_bridge/transport/transport.hpp"

namespace quoin::sensor_bridge {

/// Connects to the first of the host's addresses that answers. Looking its name up may take longer
/// than `time_out`; addresses are not looked up. Throws TransportError.
[[nodiscard]] std::unique_ptr<Transport> connect_tcp(const Endpoint& endpoint,
                                                     std::chrono::milliseconds time_out);

/// Exchanges datagrams with the host, as one stream of bytes. Whether anybody is there shows only
/// when bytes are sent. Throws TransportError.
[[nodiscard]] std::unique_ptr<Transport> connect_udp(const Endpoint& endpoint);

}  // namespace quoin::sensor_bridge
