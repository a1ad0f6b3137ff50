// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/replay_source.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "sensor_bridge/recordings/parameters.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "sensor_bridge/replay/playback.hpp"
#include "sensor_bridge/scan_declaration.hpp"

namespace quoin::sensor_bridge {
namespace {

using Seconds = std::chrono::duration<double>;
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

void publish_scans(ScanFiles& files, const ReplayParameters& parameters, runtime::Source& source) {
  msg::Scan scan = declared_scan(parameters);
  RecordedScan recorded;
  Playback playback(parameters.speed, parameters.rate_hz);
  const steady_clock::time_point start = steady_clock::now();
  for (std::int64_t count = 0; parameters.scans == 0 || count < parameters.scans; ++count) {
    if (!next(files, parameters.loop, recorded)) break;
    apply_range_limits(parameters.range_min, parameters.range_max, recorded.ranges);
    scan.bearings() = recorded.bearings;
    scan.ranges() = recorded.ranges;

    const bool stamps_were_good = playback.bad_stamps() == 0;
    const double due = playback.due(recorded, Seconds(steady_clock::now() - start).count());
    if (stamps_were_good && playback.bad_stamps() > 0) {
      source.warn("scan " + std::to_string(count) +
                  " has no usable time stamp; the last good period is kept");
    }
    if (!source.wait_until(start + std::chrono::round<steady_clock::duration>(Seconds(due))))
      return;
    const std::chrono::nanoseconds now = system_clock::now().time_since_epoch();
    scan.header().stamp(now.count());
    if (!source.publish(scan)) return;
  }
  if (playback.bad_stamps() > 0) {
    source.warn(std::to_string(playback.bad_stamps()) + " scans had no usable time stamp");
  }
}

}  // namespace

std::function<void(runtime::Source&)> open_replay(const ServiceConfig& config,
                                                  const std::filesystem::path& base_directory) {
  const auto parameters = make_parameters<ReplayParameters>(config.parameters);
  // Shared only because std::function must be copyable.
  const auto files = std::make_shared<ScanFiles>(open_scan_files(parameters, base_directory));
  return
      [parameters, files](runtime::Source& source) { publish_scans(*files, parameters, source); };
}

}  // namespace quoin::sensor_bridge
