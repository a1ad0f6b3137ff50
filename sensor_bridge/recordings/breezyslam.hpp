// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/pose.hpp"
#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

/// Scans of the robot of Mines ParisTech as BreezySLAM keeps them (.dat): a line a scan of numbers
/// without a name. The first is the stamp [us], the third and fourth are what the encoders of the
/// left and the right wheel count, and from the 25th on there are the ranges [mm] of a Hokuyo
/// URG-04LX, 0 for nothing. Wheels of 77 mm radius and 330 mm apart turn once in 2000 counts
/// (examples/mines.py of BreezySLAM); the odometry begins at the origin.
class BreezySlamScans {
 public:
  /// Throws ScanFileError.
  bool operator()(LineReader& lines, RecordedScan& scan);

 private:
  bool first_ = true;
  double left_ = 0.0;
  double right_ = 0.0;
  Pose2 pose_;
};

}  // namespace quoin::sensor_bridge
