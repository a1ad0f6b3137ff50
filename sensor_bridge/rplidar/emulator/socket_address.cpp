// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/socket_address.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <netdb.h>
#include <stdexcept>
#include <system_error>

#include "sensor_bridge/excerpt.hpp"

namespace quoin::sensor_bridge::rplidar {

SocketAddress::SocketAddress(const std::string& address, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (::getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) {
    throw std::invalid_argument("address " + excerpt(address) +
                                " is none; write it like 127.0.0.1 or ::1");
  }
  size_ = found->ai_addrlen;
  std::memcpy(&storage_, found->ai_addr, size_);
  ::freeaddrinfo(found);
}

SocketAddress SocketAddress::of(int socket) {
  SocketAddress address;
  if (::getsockname(socket, address.get(), address.size_to_fill()) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot read the address of a socket");
  }
  return address;
}

std::string SocketAddress::text() const {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (::getnameinfo(get(), size_, host.data(), host.size(), port.data(), port.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "unknown";
  }
  const std::string name = host.data();
  return (family() == AF_INET6 ? "[" + name + "]" : name) + ":" + port.data();
}

FileDescriptor bound_socket(int type, const SocketAddress& address) {
  FileDescriptor socket(::socket(address.family(), type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int yes = 1;
  if (!socket ||
      // The same port again at once after being unplugged.
      (type == SOCK_STREAM &&
       ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0) ||
      ::bind(socket.get(), address.get(), address.size()) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot listen on " + address.text());
  }
  return socket;
}

}  // namespace quoin::sensor_bridge::rplidar
