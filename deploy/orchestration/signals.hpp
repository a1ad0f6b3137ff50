// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

 private:
  int descriptor_ = -1;
};

}  // namespace quoin::deploy
