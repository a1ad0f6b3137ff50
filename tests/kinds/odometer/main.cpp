// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <idl/Lines.h>
#include <idl/Scan.h>

#include "services/runtime/node/clock.hpp"
#include "services/runtime/process/source.hpp"
#include "tests/kinds/odometer/kind.hpp"

using namespace quoin;

namespace {

using Clock = std::chrono::steady_clock;

/// Of the sensor in the middle of a round room.
msg::Scan room() {
  constexpr std::size_t rays = 180;
  constexpr float step = 0.034906585F;  // [rad] 2 degrees
  msg::Scan scan;
  scan.header().frame("laser");
  scan.sensor_model().range_stddev(0.01);
  scan.range_min(0.1F);
  scan.range_max(40.0F);
  for (std::size_t i = 0; i < rays; ++i) {
    scan.bearings().push_back(-3.1415926F + step * static_cast<float>(i));
    scan.ranges().push_back(2.0F);
  }
  return scan;
}

void publish_all(const tests::OdometerParameters& parameters, runtime::Source& source) {
  msg::Scan scan = room();
  msg::Lines lines;
  lines.header().frame("odom");
  const auto half = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(0.5 / parameters.rate_hz));
  Clock::time_point next = Clock::now();
  for (std::int64_t count = 0; parameters.scans == 0 || count < parameters.scans; ++count) {
    for (const bool scan_follows : {true, false}) {
      if (!source.wait_until(next)) return;
      lines.header().stamp(runtime::epoch_ns(next));
      if (!source.publish_also(lines)) return;
      next += half / 2;
      if (scan_follows) {
        if (!source.wait_until(next)) return;
        scan.header().stamp(runtime::epoch_ns(next));
        if (!source.publish(scan)) return;
      }
      next += half / 2;
    }
  }
}

const runtime::Registration registration(runtime::source_component(
    tests::odometer_kind(),
    [](const ServiceConfig& config, const std::filesystem::path&) {
      const auto parameters = make_parameters<tests::OdometerParameters>(config.parameters);
      return [parameters](runtime::Source& source) { publish_all(parameters, source); };
    },
    runtime::port_types(runtime::Reads<>(), runtime::Writes<msg::Scan, msg::Lines>())));

}  // namespace
