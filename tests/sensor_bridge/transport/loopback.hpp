// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace quoin::tests {

/// A socket of this computer, closed at its end.
class LoopbackSocket {
 public:
  explicit LoopbackSocket(int number) : number_(number) { EXPECT_GE(number, 0); }
  LoopbackSocket(LoopbackSocket&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ~LoopbackSocket() { close(); }

  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }
  [[nodiscard]] int number() const { return number_; }

  [[nodiscard]] std::uint16_t port() const {
    sockaddr_in6 address{};  // the port of an IPv4 address is at the same place
    socklen_t size = sizeof(address);
    EXPECT_EQ(::getsockname(number_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    return ntohs(address.sin6_port);
  }

  void send(const std::vector<std::uint8_t>& bytes) const {
    EXPECT_EQ(::send(number_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }

 private:
  int number_;
};

/// Bound to a port of the kernel's choice.
[[nodiscard]] inline LoopbackSocket bound(int type) {
  LoopbackSocket socket(::socket(AF_INET, type | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::bind(socket.number(), reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  return socket;
}

[[nodiscard]] inline LoopbackSocket listening() {
  LoopbackSocket socket = bound(SOCK_STREAM);
  EXPECT_EQ(::listen(socket.number(), 1), 0);
  return socket;
}

[[nodiscard]] inline LoopbackSocket accept_from(const LoopbackSocket& listener) {
  return LoopbackSocket(::accept4(listener.number(), nullptr, nullptr, SOCK_CLOEXEC));
}

}  // namespace quoin::tests
