// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/simulated_source.hpp"

#include <chrono>
#include <cstdint>

#include "sensor_bridge/scan_declaration.hpp"
#include "sensor_bridge/simulated/parameters.hpp"
#include "sensor_bridge/simulated/revolution_timer.hpp"
#include "sensor_bridge/simulated/world_file.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin::sensor_bridge {
namespace {

using std::chrono::steady_clock;

void publish_scans(SimulatedScanner scanner, const SimulatedParameters& parameters,
                   runtime::Source& source) {
  msg::Scan scan = declared_scan(parameters);
  SimulatedScan rays;
  const steady_clock::time_point start = steady_clock::now();
  RevolutionTimer timer(start, parameters.rate_hz);
  for (std::int64_t count = 0; parameters.scans == 0 || count < parameters.scans; ++count) {
    const RevolutionTimer::Revolution revolution = timer.next(steady_clock::now());
    const double elapsed = std::chrono::duration<double>(revolution.begin - start).count();
    scanner.scan(parameters.speed * elapsed, parameters.speed, rays);
    scan.bearings() = rays.bearings;
    scan.ranges() = rays.ranges;
    scan.time_offsets() = rays.time_offsets;
    scan.duration(rays.time_offsets.back());
    if (!source.wait_until(revolution.end)) return;
    scan.header().stamp(runtime::epoch_ns(revolution.begin));
    if (!source.publish(scan)) return;
  }
}

}  // namespace

std::function<void(runtime::Source&)> open_simulated(const ServiceConfig& config,
                                                     const std::filesystem::path& base_directory) {
  const auto parameters = make_parameters<SimulatedParameters>(config.parameters);
  SimulatedScanner scanner(load_world(parameters.environment, base_directory),
                           scanner_settings(parameters),
                           static_cast<std::uint64_t>(parameters.seed));
  return [parameters, scanner](runtime::Source& source) {
    publish_scans(scanner, parameters, source);
  };
}

}  // namespace quoin::sensor_bridge
