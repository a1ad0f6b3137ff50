// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/stop_signal.hpp"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace quoin::runtime {

StopSignal::StopSignal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal_descriptor_ = signalfd(-1, &signals, SFD_CLOEXEC);
  end_descriptor_ = eventfd(0, EFD_CLOEXEC);
  if (signal_descriptor_ < 0 || end_descriptor_ < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot watch for signals");
  }
  watcher_ = std::thread([this] { watch(); });
}

StopSignal::~StopSignal() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = write(end_descriptor_, &one, sizeof one);
  watcher_.join();
  close(signal_descriptor_);
  close(end_descriptor_);
}

void StopSignal::watch() {
  pollfd descriptors[2] = {{signal_descriptor_, POLLIN, 0}, {end_descriptor_, POLLIN, 0}};
  while (true) {
    if (poll(descriptors, 2, -1) < 0 && errno != EINTR) return;
    if ((descriptors[1].revents & POLLIN) != 0) return;
    if ((descriptors[0].revents & POLLIN) != 0) {
      signalfd_siginfo info;
      if (read(signal_descriptor_, &info, sizeof info) == static_cast<ssize_t>(sizeof info))
        request();
    }
  }
}

void Stop::request() {
  const std::lock_guard lock(mutex_);
  requested_.store(true, std::memory_order_release);
  changed_.notify_all();
  if (const auto callback = std::exchange(callback_, nullptr)) callback();
}

void Stop::on_request(std::function<void()> callback) {
  const std::lock_guard lock(mutex_);
  if (requested()) {
    if (callback) callback();
  } else {
    callback_ = std::move(callback);
  }
}

bool Stop::wait_until(std::chrono::steady_clock::time_point time) {
  std::unique_lock lock(mutex_);
  return !changed_.wait_until(lock, time, [this] { return requested(); });
}

}  // namespace quoin::runtime
