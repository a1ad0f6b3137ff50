// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <thread>

namespace quoin::deploy {

/// SIGINT and SIGTERM as something to poll for. Make it before any thread is started: threads
/// inherit that the signals are blocked.
class Signals {
 public:
  /// Throws std::system_error.
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Signals that have come since the last call.
  [[nodiscard]] int take();
  /// Whether there are some.
  [[nodiscard]] bool pending() const;
  /// From now on a signal that is not taken within a second ends the process, as it would if nobody
  /// cared for it: the process waits for something that may never come, such as room in a pipe.
  void end_when_stuck();

 private:
  void watch(const std::stop_token& stop) const;

  int descriptor_ = -1;
  std::jthread watcher_;
};

}  // namespace quoin::deploy
