// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "core/mapping/loop_search.hpp"

namespace quoin {

/// Looks for a robot that is lost, in the whole map. A pose that is found goes on with the motion,
/// and is taken when the scans that follow lie there, too.
class Relocalization {
 public:
  /// One scan and the map that it is looked for in.
  struct Scan {
    const LandmarkGraph& graph;
    const KeyframePoints& clouds;  ///< empty where the walls alone are given
    std::span<const LineMeasurement> measurements;
    std::span<const SurfacePoint> points;
    double stamp = 0.0;                         ///< [s]
    const std::optional<PoseEstimate>& motion;  ///< since the scan before
  };
  /// The pose in the map, once it is sure.
  [[nodiscard]] std::optional<Registration> look(const Scan& scan);
  /// The map has changed since it was looked at.
  void forget_map() { whole_ = PointMap{}; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.candidate_, self.found_scans_);
  }

 private:
  void build(const Scan& scan);
  [[nodiscard]] std::optional<Registration> search(const Scan& scan);

  std::optional<Pose2> candidate_;  // a pose found again, until the next scans confirm it
  int found_scans_ = 0;             // in a row that lie at candidate_
  double next_search_ = 0.0;        // [s] stamp from which the whole map is searched again
  PointMap whole_;                  // empty until it is needed
  PoseWindow window_;               // all of it
};

}  // namespace quoin
