// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <vector>

namespace quoin::tests {

/// The service manager's end of the notify protocol: NOTIFY_SOCKET of this process and of those it
/// starts.
class NotifySocket {
 public:
  /// `name`: a path, or a name in the abstract namespace with an @ in front.
  explicit NotifySocket(const std::string& name)
      : descriptor_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name.data(), name.size());
    const bool abstract = name.starts_with('@');
    if (abstract) address.sun_path[0] = '\0';
    const auto size = offsetof(sockaddr_un, sun_path) + name.size() + (abstract ? 0 : 1);
    if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address),
               static_cast<socklen_t>(size)) != 0) {
      throw std::runtime_error("cannot bind " + name + ": " + std::strerror(errno));
    }
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ~NotifySocket() {
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("WATCHDOG_USEC");
    ::close(descriptor_);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// Everything that has been said.
  std::vector<std::string> take() {
    std::vector<std::string> said;
    pollfd descriptor{descriptor_, POLLIN, 0};
    while (::poll(&descriptor, 1, 0) > 0) said.push_back(receive());
    return said;
  }
  /// The next that begins with `start`, leaving out others; "" when none comes within 20 s.
  std::string next(const std::string& start) {
    pollfd descriptor{descriptor_, POLLIN, 0};
    while (::poll(&descriptor, 1, 20'000) > 0) {
      const std::string text = receive();
      if (text.starts_with(start)) return text;
    }
    return "";
  }

 private:
  std::string receive() const {
    std::array<char, 4096> buffer{};
    const ssize_t size = ::recv(descriptor_, buffer.data(), buffer.size(), 0);
    return {buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
  }

  int descriptor_;
};

}  // namespace quoin::tests
