// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/serial_port.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "sensor_bridge/transport/file_stream.hpp"
#include "sensor_bridge/transport/port_holders.hpp"
#include "sensor_bridge/transport/serial_line.hpp"

namespace quoin::sensor_bridge {
namespace {

class SerialPort final : public FileStream {
 public:
  SerialPort(FileDescriptor descriptor, std::string name, bool exclusive)
      : FileStream(std::move(descriptor), std::move(name)), exclusive_(exclusive) {}
  ~SerialPort() override {
    if (exclusive_) (void)set_exclusive(descriptor(), false);
  }

  /// Pseudo-terminals have no such line.
  void hold_motor(bool hold) override { (void)set_terminal_ready(descriptor(), hold); }

 private:
  bool at_end() const override { return !baud_rate_of(descriptor()); }
  long put(std::span<const std::uint8_t> bytes) override {
    return ::write(descriptor(), bytes.data(), bytes.size());
  }

  bool exclusive_;
};

[[noreturn]] void throw_busy(const std::string& path) {
  std::string holders;
  for (const PortHolder& holder : holders_of(path)) {
    if (holder.process != ::getpid())
      holders += (holders.empty() ? " by " : ", ") + to_text(holder);
  }
  throw TransportError(TransportError::Kind::busy, path + ": in use" + holders);
}

/// Its other end is a program that holds both ends open: there is never a last one to close it.
bool is_pseudo_terminal(int descriptor) {
  constexpr unsigned first = 136;  // Linux: UNIX98_PTY_SLAVE_MAJOR and 8 majors
  constexpr unsigned last = 143;
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && major(status.st_rdev) >= first &&
         major(status.st_rdev) <= last;
}

/// Adapters make a rate by dividing their clock; 3 % off is what both ends together can bear.
bool is_close(unsigned rate, unsigned wanted) {
  return std::abs(static_cast<double>(rate) - wanted) <= 0.03 * wanted;
}

}  // namespace

std::unique_ptr<Transport> open_serial(const std::string& path, unsigned baud_rate) {
  // Without O_NONBLOCK the call would wait for a modem's carrier.
  FileDescriptor descriptor(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  const int port = descriptor.get();
  if (port < 0 && errno == EBUSY) throw_busy(path);
  if (port < 0) throw system_error(path, "open", errno);
  if (!baud_rate_of(port)) throw system_error(path, "open", ENOTTY);

  // The lock keeps this user's programs out, and the superuser's; exclusiveness all others', too,
  // if they know nothing of locks. It outlives a killed program where the port is never closed.
  if (::flock(port, LOCK_EX | LOCK_NB) < 0 && errno == EWOULDBLOCK) throw_busy(path);
  const bool exclusive = !is_pseudo_terminal(port) && set_exclusive(port, true) == 0;

  auto stream = std::make_unique<SerialPort>(std::move(descriptor), path, exclusive);
  const int error = set_raw_mode(port, baud_rate);
  if (error == EINVAL || (error == 0 && !is_close(baud_rate_of(port).value_or(0), baud_rate))) {
    throw TransportError(TransportError::Kind::unsupported_baud_rate,
                         path + ": the adapter cannot do " + std::to_string(baud_rate) + " baud");
  }
  if (error != 0) throw system_error(path, "set up", error);
  // The system has set the line with the opening: it stops the motor of some devices.
  stream->hold_motor(false);
  (void)flush_input(port);
  return stream;
}

}  // namespace quoin::sensor_bridge
