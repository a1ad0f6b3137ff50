// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

/// Reads on to the next FLASER line of a CARMEN text log; false at the end of the file. Other
/// messages and comments are skipped, the rear laser (RLASER) too. Throws ScanFileError, after
/// which the reader is of no more use.
///
/// The log does not hold the bearings: they run from minus half to plus half of `field_of_view`
/// [rad].
bool read_carmen_scan(LineReader& lines, double field_of_view, RecordedScan& scan);

/// Bearings [rad] of `count` rays over a swept angle that is centred on the x axis. An even number
/// of rays is a half-open sweep (180 rays at 1 degree, 360 at 0.5), an odd number has a ray at both
/// ends (181, 361): so the SICK LMS delivers them and CARMEN wrote them down.
void fill_bearings(std::size_t count, double field_of_view, std::vector<float>& bearings);

}  // namespace quoin::sensor_bridge
