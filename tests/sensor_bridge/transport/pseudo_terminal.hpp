// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace quoin::tests {

/// The far end of a serial port, held by the test.
class PseudoTerminal {
 public:
  PseudoTerminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    EXPECT_GE(master_, 0);
    EXPECT_EQ(::grantpt(master_), 0);
    EXPECT_EQ(::unlockpt(master_), 0);
    path_ = ::ptsname(master_);
  }
  ~PseudoTerminal() { unplug(); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int master() const { return master_; }

  void unplug() {
    if (master_ >= 0) ::close(master_);
    master_ = -1;
  }

  void send(const std::vector<std::uint8_t>& bytes) const {
    EXPECT_EQ(::write(master_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }

  /// Waits until that many bytes have come.
  [[nodiscard]] std::vector<std::uint8_t> receive(std::size_t count) const {
    std::vector<std::uint8_t> bytes;
    while (bytes.size() < count) {
      pollfd waited{.fd = master_, .events = POLLIN, .revents = 0};
      if (::poll(&waited, 1, 10000) <= 0) break;
      std::uint8_t buffer[256];
      const ssize_t size = ::read(master_, buffer, sizeof(buffer));
      if (size <= 0) break;
      bytes.insert(bytes.end(), buffer, buffer + size);
    }
    return bytes;
  }

 private:
  int master_;
  std::string path_;
};

}  // namespace quoin::tests
