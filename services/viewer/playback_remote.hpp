// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Control.h>
#include <mutex>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/viewer/live_view.hpp"

namespace quoin::viewer {

/// Labels of the replays of a deployment. None under `security:`, where an observer may ask nobody.
[[nodiscard]] std::vector<std::string> controllable_replays(const Deployment& deployment);

/// Pauses, steps and speeds up the replays of a deployment for the clients of a page; nothing else
/// of a service can be changed by it. It waits for no answer: heartbeats say what became of it.
class PlaybackRemote {
 public:
  PlaybackRemote(runtime::Participant& participant, const Deployment& deployment);

  /// `request`: JSON with paused, step or speed, as PlaybackControl takes them, and a service; all
  /// replays without one. Returns {"asked": [names]}. Throws std::exception for anything else.
  [[nodiscard]] std::string answer(const std::string& request);

 private:
  const std::vector<std::string> replays_;
  std::mutex mutex_;
  runtime::Writer<msg::ControlRequest> writer_;
  std::uint64_t number_ = 0;
};

/// Has the requests of a page answered as long as it lives; by nobody where there is no replay.
class PlaybackAnswers {
 public:
  PlaybackAnswers(LiveView& view, runtime::Participant& participant, const Deployment& deployment);
  ~PlaybackAnswers();
  PlaybackAnswers(const PlaybackAnswers&) = delete;
  PlaybackAnswers& operator=(const PlaybackAnswers&) = delete;

 private:
  LiveView& view_;
};

}  // namespace quoin::viewer
