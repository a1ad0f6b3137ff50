// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/harness/lossy_wire.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>

namespace quoin::tests {

using sensor_bridge::FileDescriptor;

FileDescriptor make_tap(const std::string& name) {
  FileDescriptor tap(open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC));
  ifreq request{};
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  std::memcpy(request.ifr_name, name.data(), std::min(name.size(), std::size_t{IFNAMSIZ - 1}));
  if (!tap || ioctl(tap.get(), TUNSETIFF, &request) != 0) {
    throw std::system_error(errno, std::generic_category(), "/dev/net/tun");
  }
  return tap;
}

LossyWire::LossyWire(FileDescriptor one, FileDescriptor other)
    : one_(std::move(one)), other_(std::move(other)), end_(eventfd(0, EFD_CLOEXEC)) {
  thread_ = std::thread([this] { run(); });
}

LossyWire::~LossyWire() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = write(end_.get(), &one, sizeof one);
  thread_.join();
}

void LossyWire::impair(double loss, std::chrono::milliseconds delay) {
  const std::lock_guard lock(mutex_);
  loss_ = loss;
  delay_ = delay;
}

void LossyWire::run() {
  std::array<Direction, 2> directions{Direction{one_.get(), other_.get(), {}},
                                      Direction{other_.get(), one_.get(), {}}};
  std::array<pollfd, 3> descriptors{
      {{one_.get(), POLLIN, 0}, {other_.get(), POLLIN, 0}, {end_.get(), POLLIN, 0}}};
  while (true) {
    auto wake = Clock::now() + std::chrono::seconds(1);
    for (const Direction& direction : directions) {
      if (!direction.frames.empty()) wake = std::min(wake, direction.frames.front().due);
    }
    const auto pause = std::chrono::ceil<std::chrono::milliseconds>(wake - Clock::now());
    poll(descriptors.data(), descriptors.size(),
         static_cast<int>(std::max<long>(0, pause.count())));
    if ((descriptors[2].revents & POLLIN) != 0) return;
    for (Direction& direction : directions) {
      take(direction);
      give(direction, Clock::now());
    }
  }
}

void LossyWire::take(Direction& direction) {
  std::array<char, 2048> bytes{};
  const std::lock_guard lock(mutex_);
  std::bernoulli_distribution lost(loss_);
  while (true) {
    const ssize_t size = read(direction.from, bytes.data(), bytes.size());
    if (size <= 0) return;
    if (lost(random_)) continue;
    direction.frames.push_back({Clock::now() + delay_, {bytes.begin(), bytes.begin() + size}});
  }
}

void LossyWire::give(Direction& direction, Clock::time_point now) {
  while (!direction.frames.empty() && direction.frames.front().due <= now) {
    const std::vector<char>& bytes = direction.frames.front().bytes;
    [[maybe_unused]] const auto written = write(direction.to, bytes.data(), bytes.size());
    direction.frames.pop_front();
  }
}

}  // namespace quoin::tests
