// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/file_stream.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <poll.h>
#include <thread>
#include <unistd.h>

namespace quoin::sensor_bridge {
namespace {

using Clock = std::chrono::steady_clock;

/// A serial line brings a byte each 40 us; to wake for each would cost more than all the decoding.
constexpr std::chrono::microseconds gathering_time{500};

}  // namespace

bool wait_for(int descriptor, short event, Deadline deadline) {
  pollfd waited{.fd = descriptor, .events = event, .revents = 0};
  while (true) {
    const auto left = std::max(deadline - Clock::now(), Clock::duration::zero());
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
    const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(left - seconds);
    const timespec time{.tv_sec = seconds.count(), .tv_nsec = rest.count()};
    const int ready = ::ppoll(&waited, 1, &time, nullptr);
    if (ready > 0) return true;
    if (ready == 0) return false;
    if (errno != EINTR) return true;  // the operation itself will fail
  }
}

std::size_t FileStream::read(std::span<std::uint8_t> bytes, Deadline deadline) {
  while (true) {
    const Deadline gathered = std::min(last_read_ + gathering_time, deadline);
    if (gathered > Clock::now()) std::this_thread::sleep_until(gathered);
    if (!wait_for(descriptor(), POLLIN, deadline)) return 0;
    const ssize_t count = ::read(descriptor(), bytes.data(), bytes.size());
    const int error = errno;
    last_read_ = Clock::now();
    if (count > 0) return static_cast<std::size_t>(count);
    if (count == 0 && at_end()) {
      throw TransportError(TransportError::Kind::closed,
                           name_ + ": it was unplugged or closed by the other end");
    }
    if (count < 0 && error != EAGAIN && error != EINTR) throw system_error(name_, "read", error);
    if (last_read_ >= deadline) return 0;
  }
}

void FileStream::write(std::span<const std::uint8_t> bytes, Deadline deadline) {
  while (!bytes.empty()) {
    const long count = put(bytes);
    if (count >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    } else if (errno != EAGAIN && errno != EINTR) {
      throw system_error(name_, "write", errno);
    }
    if (!bytes.empty() && (!wait_for(descriptor(), POLLOUT, deadline) || Clock::now() > deadline)) {
      throw TransportError(TransportError::Kind::timed_out, name_ + ": takes no bytes");
    }
  }
}

void FileStream::discard_input() {
  std::array<std::uint8_t, 4096> bytes;
  // Bounded, for a stream can bring bytes faster than they are thrown away.
  for (int chunk = 0; chunk < 64 && wait_for(descriptor(), POLLIN, Deadline{}); ++chunk) {
    if (::read(descriptor(), bytes.data(), bytes.size()) <= 0) return;
  }
}

}  // namespace quoin::sensor_bridge
