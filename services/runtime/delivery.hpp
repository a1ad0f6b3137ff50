// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <idl/Common.h>

#include "services/runtime/clock.hpp"
#include "services/runtime/pulse.hpp"
#include "services/runtime/stop_signal.hpp"
#include "services/runtime/writer.hpp"

namespace quoin::runtime {

/// Stamps `trace` (which is part of `message`) and writes the message. With the lossless preset the
/// write is tried again while slow readers keep the history full, but no longer than three seconds
/// once the stop is requested; else it never waits. False when the message was not written. `pulse`
/// is that of the writing thread, which is alive while it waits for readers.
template <class T>
bool deliver(Writer<T>& writer, const T& message, msg::StageTrace& trace, bool lossless,
             const StopSignal& stop, Pulse& pulse) {
  using std::chrono::steady_clock;
  auto deadline = steady_clock::time_point::max();
  while (true) {
    pulse.beat();
    trace.published(now_ns());
    if (writer.write(message)) return true;
    if (!lossless) return false;
    if (stop.requested()) {
      const auto now = steady_clock::now();
      if (deadline == steady_clock::time_point::max()) deadline = now + std::chrono::seconds(3);
      if (now >= deadline) return false;
    }
  }
}

}  // namespace quoin::runtime
