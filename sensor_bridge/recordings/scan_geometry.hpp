// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< [rad]

/// Where the rays of a recording point, as far as its user declares it.
struct ScanGeometry {
  double field_of_view = 0.0;   ///< [rad] of formats without bearings; 0: not declared
  double start_angle = 0.0;     ///< [rad] of the first ray, where angle_step is declared
  double angle_step = 0.0;      ///< [rad] from ray to ray, negative clockwise; 0: not declared
  bool clockwise = false;       ///< bearings of the file count clockwise
  bool inverted = false;        ///< the sensor hangs upside down
  double angle_offset = 0.0;    ///< [rad] added to all bearings
  double leave_out_from = 0.0;  ///< [rad] rays from here counter-clockwise
  double leave_out_to = 0.0;    ///< [rad] to here are invalid; the same: none
};

/// Bearings [rad] of `count` rays of a format that has none, centred on the x axis. A SICK LMS (a
/// step of 1, 0.5 or 0.25 deg with an even number of rays) sweeps half-open, as CARMEN wrote it
/// down: 180 rays from -90 to 89 deg. All others have a ray at both ends. Returns what a user
/// should know of that guess; "" when there is nothing.
[[nodiscard]] std::string fill_bearings(std::size_t count, const ScanGeometry& geometry,
                                        std::vector<float>& bearings);

/// What was declared, to a scan of whatever format.
void apply_geometry(const ScanGeometry& geometry, RecordedScan& scan);

}  // namespace quoin::sensor_bridge
