// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/playback_control.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <tuple>

namespace quoin::sensor_bridge {

namespace {

using Seconds = std::chrono::duration<double>;
using std::chrono::milliseconds;

// How soon a request is seen.
constexpr milliseconds slice{20};

/// What can be set while a replay runs.
struct PlaybackSettings {
  bool paused = false;
  std::int64_t step = 0;
  double speed = 1.0;

  static constexpr auto fields() {
    using P = PlaybackSettings;
    return std::tuple{
        field(&P::paused, "paused", "nothing is published until it is false again"),
        field(&P::step, "step", "", 0.0, 1e9, "publish so many messages, and be paused then"),
        field(&P::speed, "speed", "", 0.0, 1000.0, "factor on the recorded speed; 0: no waiting")};
  }
};

std::string text_of(const char* format, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

PlaybackControl::PlaybackControl(const ReplayParameters& parameters, runtime::Source& source)
    : source_(source), playback_(parameters.speed, parameters.rate_hz) {
  wishes_->paused = parameters.paused;
  wishes_->speed = parameters.speed;
  controlled_ = source.answer_settings(
      [wishes = wishes_](const ParameterSettings& asked) { return answer(*wishes, asked); });
}

ParameterSettings PlaybackControl::answer(Wishes& wishes, const ParameterSettings& asked) {
  const auto settings = make_parameters<PlaybackSettings>(asked);
  const auto set = [&](const char* name) {
    return std::ranges::count(asked, name, &ParameterSetting::name) > 0;
  };
  const std::lock_guard lock(wishes.mutex);
  if (set("speed")) wishes.speed = settings.speed;
  if (set("paused")) {
    wishes.paused = settings.paused;
    wishes.steps = 0;
  }
  if (set("step")) {
    wishes.paused = true;
    wishes.steps += settings.step;
  }
  return {{"paused", wishes.paused ? "true" : "false"}, {"speed", text_of("%g", wishes.speed)}};
}

double PlaybackControl::now() const { return Seconds(Clock::now() - start_).count(); }

bool PlaybackControl::wait_for(const RecordedScan& scan) {
  return wait_until_due(playback_.due(scan, now()));
}

bool PlaybackControl::wait_for(std::int64_t time) {
  return wait_until_due(playback_.due_at(static_cast<double>(time) * 1e-9, now()));
}

bool PlaybackControl::wait_until_due(double due) {
  while (true) {
    bool step = false;
    {
      const std::lock_guard lock(wishes_->mutex);
      if (wishes_->speed != playback_.speed()) due = playback_.set_speed(wishes_->speed, now());
      step = wishes_->paused && wishes_->steps > 0;
      if (step) --wishes_->steps;
      paused_ = wishes_->paused;
    }
    report();
    const auto at = start_ + std::chrono::round<Clock::duration>(Seconds(due));
    if (step) return source_.wait_until(Clock::now());
    if (!paused_ && (!controlled_ || Clock::now() + slice >= at)) return source_.wait_until(at);
    if (!source_.wait_until(paused_ ? Clock::now() + slice : std::min(at, Clock::now() + slice))) {
      return false;
    }
  }
}

void PlaybackControl::note_progress(std::optional<double> progress) { progress_ = progress; }

/// At most once a second.
void PlaybackControl::report() {
  const auto time = Clock::now();
  if (!controlled_ || (reported_ && time - *reported_ < std::chrono::seconds(1))) return;
  reported_ = time;
  const double speed = playback_.speed();
  source_.set_diagnostic("Playback", paused_       ? "paused"
                                     : speed > 0.0 ? text_of("%g x", speed)
                                                   : "without waiting");
  source_.set_diagnostic("Recorded Time", text_of("%.1f s", playback_.recorded_time()));
  if (progress_) source_.set_diagnostic("Progress", text_of("%.0f %%", *progress_ * 100.0));
}

}  // namespace quoin::sensor_bridge
