// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <arpa/inet.h>
#include <asm/termbits.h>
#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <span>
#include <string>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "sensor_bridge/transport/file_descriptor.hpp"
#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"

namespace quoin::sensor_bridge::rplidar {

inline bool ends_with(const Bytes& bytes, const Bytes& end) {
  return bytes.size() >= end.size() && std::equal(end.rbegin(), end.rend(), bytes.rbegin());
}

/// A program that knows no more than how to open what an emulator offers.
class PlainClient {
 public:
  /// A path of a serial port, "tcp://127.0.0.1:port" or "udp://127.0.0.1:port".
  explicit PlainClient(const std::string& endpoint, unsigned baud_rate = 256000) {
    if (endpoint.starts_with("tcp://") || endpoint.starts_with("udp://")) {
      descriptor_ = FileDescriptor(
          ::socket(AF_INET, (endpoint[0] == 't' ? SOCK_STREAM : SOCK_DGRAM) | SOCK_CLOEXEC, 0));
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      address.sin_port =
          htons(static_cast<std::uint16_t>(std::stoul(endpoint.substr(endpoint.rfind(':') + 1))));
      connected_ = ::connect(descriptor_.get(), reinterpret_cast<const sockaddr*>(&address),
                             sizeof address) == 0;
    } else {
      descriptor_ =
          FileDescriptor(::open(endpoint.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
      connected_ = static_cast<bool>(descriptor_);
      if (connected_) set_baud_rate(baud_rate);
    }
  }

  [[nodiscard]] bool connected() const { return connected_; }

  void set_baud_rate(unsigned baud_rate) const {
    termios2 mode{};
    ASSERT_EQ(::ioctl(descriptor_.get(), TCGETS2, &mode), 0);
    // The rest of a new port suits.
    EXPECT_EQ(mode.c_iflag, 0U);
    EXPECT_EQ(mode.c_oflag, 0U);
    EXPECT_EQ(mode.c_lflag, 0U);
    mode.c_cflag = (mode.c_cflag & ~static_cast<unsigned>(CBAUD)) | BOTHER;
    mode.c_ispeed = baud_rate;
    mode.c_ospeed = baud_rate;
    ASSERT_EQ(::ioctl(descriptor_.get(), TCSETS2, &mode), 0);
  }

  void send(std::string_view bytes) const {
    const Bytes content = hex(bytes);
    EXPECT_EQ(::write(descriptor_.get(), content.data(), content.size()),
              static_cast<ssize_t>(content.size()));
  }

  /// What one read gives when something has come; nothing when nothing comes for `limit` [ms], or
  /// at the end of the stream, when `ended` becomes true.
  Bytes read(int limit = 10000) {
    pollfd waited{descriptor_.get(), POLLIN, 0};
    if (::poll(&waited, 1, limit) <= 0) return {};
    Bytes bytes(4096);
    const ssize_t size = ::read(descriptor_.get(), bytes.data(), bytes.size());
    if (size <= 0 && errno != EAGAIN) ended_ = true;
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }

  /// Waits for at least that many bytes.
  Bytes receive(std::size_t count) {
    Bytes bytes;
    while (bytes.size() < count) {
      const Bytes more = read();
      if (more.empty()) break;
      bytes = bytes + more;
    }
    return bytes;
  }

  /// Waits for what ends with these bytes.
  Bytes receive_until(const Bytes& end) {
    Bytes bytes;
    while (!ends_with(bytes, end)) {
      const Bytes more = read();
      if (more.empty()) break;
      bytes = bytes + more;
    }
    return bytes;
  }

  Bytes ask(std::string_view request, std::size_t count) {
    send(request);
    return receive(count);
  }

  [[nodiscard]] bool ended() const { return ended_; }

 private:
  FileDescriptor descriptor_;
  bool connected_ = false;
  bool ended_ = false;
};

}  // namespace quoin::sensor_bridge::rplidar
