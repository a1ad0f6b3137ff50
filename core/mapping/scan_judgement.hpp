// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/mapping/localizer.hpp"
#include "core/mapping/wall_belief.hpp"

namespace quoin {

inline constexpr double least_share = 0.4;    ///< of the points of a scan that lie on the map
inline constexpr double least_refuted = 1.0;  ///< [m] of walls seen through that count

/// Length [m] of mapped walls (indices in `map`) through which lines of the scan are seen.
[[nodiscard]] double seen_through(const Pose2& pose, std::span<const LineLandmark> map,
                                  std::span<const std::size_t> walls,
                                  std::span<const LineMeasurement> measurements);

/// What speaks for and against the pose of a scan.
struct ScanEvidence {
  std::span<const LineLandmark> map;
  std::span<const LineMeasurement> measurements;
  const WallBelief& posterior;
  const WallPairs& pairs;
  double share = 0.0;       ///< of the points that lie on the map around; 0 when not registered
  double last_share = 0.0;  ///< the same of the last scan that fitted
  std::size_t points = 0;   ///< of the scan
  Pose2 expected_step;      ///< since the last scan, before anything was seen
  bool has_odometry = false;
};

struct ScanJudgement {
  bool fits = true;  ///< the scan may be of where the robot should be
  LocalizationStatus status = LocalizationStatus::tracking;  ///< unless the robot is lost
  std::optional<double> weak_direction;  ///< [rad] in the map, in which the walls say nothing
};

[[nodiscard]] ScanJudgement judge(const ScanEvidence& evidence);

/// Whether the robot is lost, by how many scans in a row fit.
class LossMonitor {
 public:
  [[nodiscard]] bool is_lost() const { return lost_; }
  void begin_lost() { lost_ = true; }
  void found() { lost_ = false; }
  /// A scan that fits; `well`, nearly all of it: some of these in a row end being lost.
  void add_fit(double stamp, bool well);
  /// A scan that does not fit; true when the robot is lost by that.
  bool add_misfit(double stamp);

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.fitted_at_, self.unfit_scans_, self.back_scans_, self.lost_);
  }

 private:
  double fitted_at_ = 0.0;  // [s] stamp of the last scan that fitted
  int unfit_scans_ = 0;     // in a row
  int back_scans_ = 0;      // in a row that fit well while lost
  bool lost_ = false;
};

inline constexpr int lost_scans = 3;  ///< in a row, whatever the time

}  // namespace quoin
