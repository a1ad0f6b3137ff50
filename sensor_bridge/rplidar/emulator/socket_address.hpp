// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <sys/socket.h>

#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::sensor_bridge::rplidar {

/// A numeric IPv4 or IPv6 address with a port.
class SocketAddress {
 public:
  SocketAddress() = default;
  /// Throws std::invalid_argument when `address` is none.
  SocketAddress(const std::string& address, std::uint16_t port);

  /// The one that the socket is bound to.
  [[nodiscard]] static SocketAddress of(int socket);

  /// "127.0.0.1:20108", "[::1]:20108".
  [[nodiscard]] std::string text() const;

  [[nodiscard]] int family() const { return storage_.ss_family; }
  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage_); }
  [[nodiscard]] sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage_); }
  [[nodiscard]] socklen_t size() const { return size_; }
  [[nodiscard]] socklen_t* size_to_fill() {
    size_ = sizeof storage_;
    return &size_;
  }

 private:
  sockaddr_storage storage_{};
  socklen_t size_ = 0;
};

/// A socket of this type (SOCK_STREAM, SOCK_DGRAM) that does not wait, bound to the address. Throws
/// std::system_error.
[[nodiscard]] FileDescriptor bound_socket(int type, const SocketAddress& address);

}  // namespace quoin::sensor_bridge::rplidar
