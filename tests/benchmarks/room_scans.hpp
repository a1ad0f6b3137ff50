// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Scan.h>
#include <vector>

#include "core/simulation/scanner.hpp"
#include "services/runtime/node/clock.hpp"
#include "services/topics/header.hpp"
#include "services/topics/segments.hpp"

namespace quoin::benchmarks {

/// Twenty different revolutions of a 920-point sensor in the domestic room.
inline std::vector<msg::Scan> make_scans() {
  SimulatedScanner scanner(
      *built_in_world("domestic_room"),
      [] {
        ScannerSettings settings;
        settings.noise = SensorModel{};
        return settings;
      }(),
      1);
  std::vector<msg::Scan> scans(20);
  SimulatedScan simulated;
  for (msg::Scan& scan : scans) {
    scanner.scan(0.0, 0.0, simulated);
    scan.bearings(simulated.bearings);
    scan.ranges(simulated.ranges);
    scan.range_min(0.1F);
    scan.range_max(40.0F);
    scan.sensor_model(topics::sensor_model_message(SensorModel{}));
    scan.header().frame("laser");
    scan.header().trace().resize(1);
    scan.header().trace()[0].service("front");
    scan.header().trace()[0].incarnation(1);
  }
  return scans;
}

/// Gives a scan the next number of the source "front", and the present time.
inline void number(msg::Scan& scan, std::uint64_t next) {
  topics::set_origin(scan.header(), "front", 1, next);
  msg::StageTrace& trace = scan.header().trace()[0];
  trace.index(next);
  trace.published(runtime::now_ns());
}

}  // namespace quoin::benchmarks
