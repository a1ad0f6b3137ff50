// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/serial_line.hpp"

#include <asm/termbits.h>
#include <cerrno>
#include <sys/ioctl.h>

namespace quoin::sensor_bridge {
namespace {

int result(int status) { return status < 0 ? errno : 0; }

}  // namespace

int set_raw_mode(int descriptor, unsigned baud_rate) {
  termios2 mode{};
  if (::ioctl(descriptor, TCGETS2, &mode) < 0) return errno;
  mode.c_iflag = 0;
  mode.c_oflag = 0;
  mode.c_lflag = 0;
  mode.c_cflag = BOTHER | CS8 | CREAD | CLOCAL;  // an input rate of 0 bits is that of the output
  mode.c_ispeed = baud_rate;
  mode.c_ospeed = baud_rate;
  mode.c_cc[VMIN] = 0;
  mode.c_cc[VTIME] = 0;
  return result(::ioctl(descriptor, TCSETS2, &mode));
}

std::optional<unsigned> baud_rate_of(int descriptor) {
  termios2 mode{};
  if (::ioctl(descriptor, TCGETS2, &mode) < 0) return std::nullopt;
  return mode.c_ospeed;
}

int set_exclusive(int descriptor, bool exclusive) {
  return result(::ioctl(descriptor, exclusive ? TIOCEXCL : TIOCNXCL));
}

int set_terminal_ready(int descriptor, bool ready) {
  const int line = TIOCM_DTR;
  return result(::ioctl(descriptor, ready ? TIOCMBIS : TIOCMBIC, &line));
}

int flush_input(int descriptor) { return result(::ioctl(descriptor, TCFLSH, TCIFLUSH)); }

}  // namespace quoin::sensor_bridge
