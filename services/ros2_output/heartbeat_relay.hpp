// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "services/runtime/dds/participant.hpp"

namespace quoin {

/// Publishes the heartbeats of all services of a namespace as one diagnostic_msgs/DiagnosticArray a
/// second on /diagnostics, from a thread of its own: also when no scan comes.
class HeartbeatRelay {
 public:
  /// `owner`: label of the service that it belongs to.
  HeartbeatRelay(runtime::Participant& participant, const std::string& owner,
                 const std::string& name_space);
  ~HeartbeatRelay();
  HeartbeatRelay(const HeartbeatRelay&) = delete;
  HeartbeatRelay& operator=(const HeartbeatRelay&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quoin
