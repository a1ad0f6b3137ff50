// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"
#include "sensor_bridge/recordings/scan_geometry.hpp"

namespace quoin::sensor_bridge {

/// Scans of the front laser in a CARMEN text log: FLASER lines, which hold no bearings, and
/// ROBOTLASER1 and RAWLASER1 lines, which do. Other messages and comments are skipped, other
/// lasers, too. Throws ScanFileError, after which the reader is of no more use.
///
/// Odometry is that of the scans, and between them that of ODOM lines whose stamps lie between
/// those of the scans: in many logs some do not.
class CarmenScans {
 public:
  explicit CarmenScans(const ScanGeometry& geometry) : geometry_(geometry) {}

  /// Reads on to the next scan; false at the end of the file. One of no rays is a scan.
  bool operator()(LineReader& lines, RecordedScan& scan);

 private:
  ScanGeometry geometry_;
  std::optional<double> last_odometry_;  // [s] stamp
  bool bad_odometry_ = false;            // has been noted
};

}  // namespace quoin::sensor_bridge
