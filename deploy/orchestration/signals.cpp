// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/signals.hpp"

#include <cerrno>
#include <chrono>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <system_error>
#include <unistd.h>

namespace quoin::deploy {

namespace {
constexpr std::chrono::milliseconds look_period{50};
constexpr std::chrono::seconds longest_wait{1};
}  // namespace

Signals::Signals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGINT);
  ::sigaddset(&signals, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  descriptor_ = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
}

Signals::~Signals() {
  watcher_ = {};
  ::close(descriptor_);
}

bool Signals::pending() const {
  pollfd descriptor{descriptor_, POLLIN, 0};
  return ::poll(&descriptor, 1, 0) == 1;
}

void Signals::end_when_stuck() {
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

void Signals::watch(const std::stop_token& stop) const {
  for (int waited = 0; !stop.stop_requested();) {
    std::this_thread::sleep_for(look_period);
    waited = pending() ? waited + 1 : 0;
    if (waited * look_period < longest_wait) continue;
    signalfd_siginfo information{};
    if (::read(descriptor_, &information, sizeof information) != sizeof information) continue;
    const int signal = static_cast<int>(information.ssi_signo);
    ::signal(signal, SIG_DFL);
    sigset_t signals;
    ::sigemptyset(&signals);
    ::sigaddset(&signals, signal);
    ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    ::raise(signal);
  }
}

int Signals::take() {
  int count = 0;
  signalfd_siginfo information{};
  while (::read(descriptor_, &information, sizeof information) == sizeof information) ++count;
  return count;
}

}  // namespace quoin::deploy
