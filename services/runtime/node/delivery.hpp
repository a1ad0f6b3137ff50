// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <idl/Common.h>

#include "services/runtime/process/clock.hpp"
#include "services/runtime/process/pulse.hpp"
#include "services/runtime/process/stop_signal.hpp"
#include "services/runtime/dds/writer.hpp"

namespace quoin::runtime {

/// How long the end of a service may wait: for room in a full history once the stop is requested,
/// and for the last results to be acknowledged. With a write that was under way and the last
/// heartbeat it is less than the five seconds after which `quoin up` kills.
inline constexpr std::chrono::seconds longest_wait_for_room{1};
inline constexpr std::chrono::seconds longest_wait_for_acknowledgments{2};

/// Stamps `trace` (which is part of `message`) and writes the message. With the lossless preset the
/// write is tried again while slow readers keep the history full, until longest_wait_for_room after
/// the stop is requested; else it never waits. False when the message was not written. `pulse`
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
      if (deadline == steady_clock::time_point::max()) deadline = now + longest_wait_for_room;
      if (now >= deadline) return false;
    }
  }
}

}  // namespace quoin::runtime
