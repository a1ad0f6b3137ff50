// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <idl/Common.h>

#include "services/runtime/node/ports.hpp"
#include "services/runtime/node/pulse.hpp"
#include "services/runtime/node/service_record.hpp"

namespace quoin::runtime {

/// How long the end of a service may wait: for room in a full history once the stop is requested,
/// and for the last results to be acknowledged. With a write that was under way and the last
/// heartbeat it is less than the five seconds after which `quoin up` kills.
inline constexpr std::chrono::seconds longest_wait_for_room{1};
inline constexpr std::chrono::seconds longest_wait_for_acknowledgments{2};

/// What the thread that data passes through works with.
struct DataThread {
  ServiceRecord& record;
  Pulse& pulse;                    ///< alive while it waits for readers
  std::function<bool()> stopping;  ///< whether the service was asked to stop
  /// The clock by which is waited.
  std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now;
};

/// Stamps `trace` (which is part of the output's message) and writes the message. With the lossless
/// preset the write is tried again while slow readers keep the history full, until
/// longest_wait_for_room after the stop is requested; readers that are dead are dropped meanwhile,
/// and the record says who keeps it waiting. Otherwise it never waits. False when the message was
/// not written.
[[nodiscard]] bool deliver(Output& output, msg::StageTrace& trace, bool lossless,
                           DataThread& thread);

}  // namespace quoin::runtime
