// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"
#include "sensor_bridge/recordings/scan_geometry.hpp"

namespace quoin::sensor_bridge {

/// Scans of the front laser in a CARMEN text log: FLASER lines, which hold no bearings, and
/// ROBOTLASER1 and RAWLASER1 lines, which do. Other messages and comments are skipped, other
/// lasers, too. Throws ScanFileError, after which the reader is of no more use.
class CarmenScans {
 public:
  explicit CarmenScans(const ScanGeometry& geometry) : geometry_(geometry) {}

  /// Reads on to the next scan; false at the end of the file. One of no rays is a scan.
  bool operator()(LineReader& lines, RecordedScan& scan);

 private:
  ScanGeometry geometry_;
};

}  // namespace quoin::sensor_bridge
