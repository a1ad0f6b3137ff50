// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/replay_source.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <idl/Odometry.h>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "sensor_bridge/recordings/parameters.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "sensor_bridge/replay/message_replay.hpp"
#include "sensor_bridge/replay/playback_control.hpp"
#include "sensor_bridge/scan_declaration.hpp"
#include "services/topics/poses.hpp"
#include "services/topics/segments.hpp"

namespace quoin::sensor_bridge {
namespace {

using std::chrono::steady_clock;
using std::chrono::system_clock;

bool next(ScanFiles& files, bool loop, RecordedScan& scan) try {
  if (files.next(scan)) return true;
  if (!loop) return false;
  files.rewind();
  return files.next(scan);
} catch (const ScanFileError& error) {
  throw runtime::SourceError(error.what());
}

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

/// Odometry of the recording, stamped by the same clock as the scans.
class OdometryOutput {
 public:
  explicit OdometryOutput(const ReplayParameters& parameters)
      : wanted_(parameters.odometry),
        frame_(parameters.odometry_frame),
        child_frame_(parameters.base_frame) {}

  /// What was recorded up to `scan`, which is stamped with `stamp` [ns].
  bool publish(const RecordedScan& scan, std::int64_t stamp, runtime::Source& source) {
    if (!wanted_) return true;
    for (const RecordedOdometry& odometry : scan.odometry) {
      const double after = odometry.stamp && scan.stamp ? *odometry.stamp - *scan.stamp : 0.0;
      // Farther off it is a wrong stamp.
      if (!(std::abs(after) <= Playback::longest_period)) continue;
      const bool exact = odometry.epoch_stamp && scan.epoch_stamp;
      message_.header().stamp(
          stamp + (exact ? *odometry.epoch_stamp - *scan.epoch_stamp : nanoseconds(after)));
      name_frames(odometry);
      message_.pose(topics::pose_message({odometry.pose, odometry.covariance}));
      message_.velocity_known(odometry.velocity.has_value());
      const Eigen::Vector3d velocity = odometry.velocity.value_or(Eigen::Vector3d::Zero());
      message_.velocity_x(velocity.x());
      message_.velocity_y(velocity.y());
      message_.velocity_theta(velocity.z());
      if (!source.publish_also(message_)) return false;
      ++published_;
    }
    return true;
  }

  [[nodiscard]] bool found_nothing() const { return wanted_ && published_ == 0; }

 private:
  /// Those of the recording, unless the deployment names others.
  void name_frames(const RecordedOdometry& odometry) {
    const ReplayParameters usual;
    const auto name = [](const std::string& declared, const std::string& by_default,
                         const std::string& recorded) {
      return declared == by_default && !recorded.empty() ? recorded : declared;
    };
    message_.header().frame(name(frame_, usual.odometry_frame, odometry.frame));
    message_.child_frame(name(child_frame_, usual.base_frame, odometry.child_frame));
  }

  bool wanted_;
  std::string frame_;
  std::string child_frame_;
  msg::Odometry message_;
  std::size_t published_ = 0;
};

/// What the recording has of the scan; the rest is as declared.
void fill_scan(const RecordedScan& recorded, const ReplayParameters& parameters, msg::Scan& scan) {
  scan.bearings() = recorded.bearings;
  scan.ranges() = recorded.ranges;
  scan.time_offsets() = recorded.time_offsets;
  scan.duration(recorded.time_offsets.empty() ? 0.0F : recorded.time_offsets.back());
  if (recorded.duration) scan.duration(static_cast<float>(*recorded.duration));
  scan.qualities().clear();
  const bool frame_of_file = parameters.frame == ReplayParameters().frame;
  if (!recorded.frame.empty() && frame_of_file) scan.header().frame(recorded.frame);
  if (recorded.sensor) {
    // A scan of ours: as it was, unless the deployment says otherwise of its sensor.
    scan.qualities() = recorded.qualities;
    if (!parameters.declares_sensor()) {
      scan.sensor_model(topics::sensor_model_message(*recorded.sensor));
      scan.sensor_model().estimated(recorded.sensor_estimated);
    }
  }
  const bool limits_of_file = parameters.range_max == ReplayParameters::usual_range_max;
  if (recorded.range_max && limits_of_file) {
    scan.range_max(static_cast<float>(*recorded.range_max));
    if (recorded.range_min && parameters.range_min == 0.0) {
      scan.range_min(static_cast<float>(*recorded.range_min));
    }
  }
}

void publish_scans(ScanFiles& files, const ReplayParameters& parameters, runtime::Source& source) {
  msg::Scan scan = declared_scan(parameters);
  RecordedScan recorded;
  OdometryOutput odometry(parameters);
  PlaybackControl control(parameters, source);
  const Playback& playback = control.playback();
  std::optional<std::int64_t> first_stamp;  // [ns] as recorded
  std::set<std::string> told;               // notes
  // From here on it counts how long nothing is heard of it: a file may have no scan for long.
  if (!source.wait_until(steady_clock::now())) return;
  for (std::int64_t count = 0; parameters.scans == 0 || count < parameters.scans; ++count) {
    if (!next(files, parameters.loop, recorded)) break;
    for (const std::string& note : recorded.notes) {
      if (told.insert(note).second) source.warn(note);
    }
    fill_scan(recorded, parameters, scan);

    const bool stamps_were_good = playback.bad_stamps() == 0;
    control.note_progress(files.progress());
    if (!control.wait_for(recorded)) return;
    if (stamps_were_good && playback.bad_stamps() > 0) {
      source.warn("scan " + std::to_string(count) +
                  " has no usable time stamp; the last good period is kept");
    }
    const std::chrono::nanoseconds now = system_clock::now().time_since_epoch();
    std::int64_t stamp = now.count();
    if (parameters.stamps == ReplayStamps::recorded) {
      if (!first_stamp) first_stamp = recorded.stamp ? nanoseconds(*recorded.stamp) : stamp;
      stamp = *first_stamp + nanoseconds(playback.recorded_time());
      const bool exact = playback.bad_stamps() == 0 && !parameters.loop;
      if (recorded.epoch_stamp && exact) stamp = *recorded.epoch_stamp;
    }
    if (!odometry.publish(recorded, stamp, source)) return;
    scan.header().stamp(stamp);
    if (!source.publish(scan)) return;
  }
  if (odometry.found_nothing()) source.warn("the recording holds no odometry");
  if (playback.bad_stamps() > 0) {
    source.warn(std::to_string(playback.bad_stamps()) + " scans had no usable time stamp");
  }
}

}  // namespace

std::function<void(runtime::Source&)> open_replay(const ServiceConfig& config,
                                                  const std::filesystem::path& base_directory) {
  const auto parameters = make_parameters<ReplayParameters>(config.parameters);
  if (replays_messages(parameters)) return open_message_replay(parameters, base_directory);
  // Shared only because std::function must be copyable.
  const auto files = std::make_shared<ScanFiles>(open_scan_files(parameters, base_directory));
  return
      [parameters, files](runtime::Source& source) { publish_scans(*files, parameters, source); };
}

}  // namespace quoin::sensor_bridge
