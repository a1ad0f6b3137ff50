// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <idl/Odometry.h>
#include <optional>
#include <string>

#include "core/mapping/motion.hpp"
#include "services/localization/parameters.hpp"

namespace quoin {

/// How the sensor has moved from scan to scan by the odometry around their stamps. Odometry that
/// jumps, stops, goes back in time or has gaps gives nothing for the scans that it concerns.
class OdometryMotion {
 public:
  explicit OdometryMotion(const RobotParameters& parameters);

  /// The next scan, of `stamp` [ns], with the messages before and after that; null where there is
  /// none. The motion of the sensor since the scan before, in its frame then.
  [[nodiscard]] std::optional<PoseEstimate> to_scan(std::int64_t stamp, const msg::Odometry* before,
                                                    const msg::Odometry* after);

  /// Scans whose odometry was there, but not usable, and why the last one was not.
  [[nodiscard]] std::size_t rejected() const { return rejected_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  /// Where the robot was at a stamp, by its odometry.
  struct Instant {
    std::int64_t stamp = 0;  // [ns]
    PoseEstimate pose;
    std::string frame;
  };

  [[nodiscard]] std::optional<Instant> at(std::int64_t stamp, const msg::Odometry* before,
                                          const msg::Odometry* after);
  [[nodiscard]] bool too_fast(const Pose2& way, double seconds) const;
  std::nullopt_t reject(const std::string& why);

  RobotParameters parameters_;
  OdometryNoise noise_;
  Pose2 mounting_;
  Pose2 from_mounting_;  // of the robot in the frame of the sensor
  std::optional<Instant> last_;
  std::size_t rejected_ = 0;
  std::string reason_;
};

}  // namespace quoin
