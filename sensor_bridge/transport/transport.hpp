// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "sensor_bridge/transport/endpoint.hpp"
#include "sensor_bridge/transport/transport_error.hpp"

namespace quoin::sensor_bridge {

using Deadline = std::chrono::steady_clock::time_point;

/// A stream of bytes to and from a device. Its functions throw TransportError when the stream is at
/// its end, which cannot be distinguished from silence otherwise. One thread at a time.
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  /// Reads what has arrived, at least one byte; waits for it until the deadline at most and returns
  /// 0 then. Bytes that come in a trickle are let gather for 0.5 ms from one call to the next.
  [[nodiscard]] virtual std::size_t read(std::span<std::uint8_t> bytes, Deadline deadline) = 0;

  /// Hands all bytes over; the error is `timed_out` when that takes longer than to the deadline.
  virtual void write(std::span<const std::uint8_t> bytes, Deadline deadline) = 0;

  /// Throws away what has arrived.
  virtual void discard_input() = 0;

  /// Sets the line by which devices without a speed command stop their motor: clear to
  /// let it run. Of no effect where there is no such line.
  virtual void hold_motor(bool /*hold*/) {}
};

/// Opens the endpoint for the use of this program alone. `baud_rate` is for serial ports only.
/// `time_out` bounds how long a connection may take. Throws TransportError.
[[nodiscard]] std::unique_ptr<Transport> open_transport(const Endpoint& endpoint,
                                                        unsigned baud_rate,
                                                        std::chrono::milliseconds time_out);

}  // namespace quoin::sensor_bridge
