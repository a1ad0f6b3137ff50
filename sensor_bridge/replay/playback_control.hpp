// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "sensor_bridge/recordings/parameters.hpp"
#include "sensor_bridge/replay/playback.hpp"
#include "services/runtime/process/source.hpp"

namespace quoin::sensor_bridge {

/// Paces the messages of a replay, and lets it be paused, stepped and set to another speed while it
/// runs (`quoin set`): paused (true, false), step (so many messages, then paused), speed. The
/// heartbeat says where it is.
class PlaybackControl {
 public:
  PlaybackControl(const ReplayParameters& parameters, runtime::Source& source);

  /// Returns when the next scan is to be published; false when the service is to stop.
  [[nodiscard]] bool wait_for(const RecordedScan& scan);
  /// The same for a message that was recorded at that time [ns].
  [[nodiscard]] bool wait_for(std::int64_t time);

  /// How much of the recording is behind, 0 to 1, where that is known.
  void note_progress(std::optional<double> progress);

  [[nodiscard]] const Playback& playback() const { return playback_; }

 private:
  using Clock = std::chrono::steady_clock;
  // Shared with the thread that answers requests.
  struct Wishes {
    std::mutex mutex;
    bool paused = false;
    std::int64_t steps = 0;  // to publish although it is paused
    double speed = 1.0;
  };

  [[nodiscard]] static ParameterSettings answer(Wishes& wishes, const ParameterSettings& asked);
  [[nodiscard]] double now() const;
  [[nodiscard]] bool wait_until_due(double due);
  void report();

  runtime::Source& source_;
  Playback playback_;
  const std::shared_ptr<Wishes> wishes_ = std::make_shared<Wishes>();
  const Clock::time_point start_ = Clock::now();
  bool controlled_;  // somebody can ask
  bool paused_ = false;
  std::optional<double> progress_;
  std::optional<Clock::time_point> reported_;
};

}  // namespace quoin::sensor_bridge
