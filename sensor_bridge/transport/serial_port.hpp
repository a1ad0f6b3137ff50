// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "sensor_bridge/transport/transport.hpp"

namespace quoin::sensor_bridge {

/// Opens a serial port for this program alone, at any baud rate, without what arrived before.
/// Throws TransportError.
[[nodiscard]] std::unique_ptr<Transport> open_serial(const std::string& path, unsigned baud_rate);

}  // namespace quoin::sensor_bridge
