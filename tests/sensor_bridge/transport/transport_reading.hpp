// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <vector>

#include "sensor_bridge/transport/transport.hpp"

namespace quoin::sensor_bridge {

[[nodiscard]] inline Deadline in(std::chrono::milliseconds time) {
  return std::chrono::steady_clock::now() + time;
}

/// What comes, until it is that much or 10 s have passed.
[[nodiscard]] inline std::vector<std::uint8_t> read_all(Transport& transport, std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  std::size_t size = 0;
  const Deadline deadline = in(std::chrono::seconds(10));
  while (size < count) {
    const std::size_t more = transport.read(std::span(bytes).subspan(size), deadline);
    if (more == 0) break;
    size += more;
  }
  bytes.resize(size);
  return bytes;
}

/// The kind of error that `call` ends with.
template <class Call>
[[nodiscard]] TransportError::Kind kind_of(Call&& call) {
  try {
    call();
  } catch (const TransportError& error) {
    return error.kind();
  }
  throw std::logic_error("no transport error");
}

}  // namespace quoin::sensor_bridge
