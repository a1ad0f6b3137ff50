// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <idl/Scan.h>
#include <optional>
#include <vector>

#include "services/ros2/messages.hpp"

namespace quoin::ros2 {

/// Turns scans into sensor_msgs/LaserScan with the same beams in every message, counter-clockwise,
/// as programs of ROS 2 expect. A beam holds the range of the ray nearest to its direction, of
/// those not farther off than half a beam; NaN where there is none (REP-117). No range is computed.
class ScanExport {
 public:
  /// `beams`: 0 for as many as the first scan has rays.
  explicit ScanExport(std::size_t beams) : wanted_(beams) {}

  /// False for a scan that no beams can be laid out by, as long as there was no other. Beams have
  /// times only where they are in the order of acquisition.
  [[nodiscard]] bool convert(const msg::Scan& in, LaserScan& out);

 private:
  /// Over a whole turn from -pi on, shifted by less than a beam so that they meet the rays of the
  /// first scan, or over the sector of the first scan.
  struct Beams {
    double first = 0.0;  // [rad]
    double step = 0.0;   // [rad]
    std::size_t count = 0;
    bool whole_turn = false;

    /// The nearest one; nothing outside of the sector. `off` [rad]: from its direction.
    [[nodiscard]] std::optional<std::size_t> nearest(double bearing, double& off) const;
  };
  [[nodiscard]] static std::optional<Beams> beams_of(const msg::Scan& scan, std::size_t wanted);

  std::size_t wanted_;
  std::optional<Beams> beams_;
  std::vector<double> off_;  // [rad] of the ray that a beam holds
  std::int64_t last_stamp_ = 0;
};

}  // namespace quoin::ros2
