// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/corners/corner_finder.hpp"
#include "core/evaluation/disturbed_scans.hpp"
#include "core/extraction/extraction.hpp"
#include "core/geometry/pose.hpp"
#include "core/simulation/world.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// How much of each of its walls must be seen, up to the corner, of a corner that is to be found.
struct SeenWalls {
  std::size_t min_points = 8;
  double min_length = 0.3;  ///< [m]
};

/// The true corners as a resting sensor sees them.
struct CornerTruth {
  std::vector<Eigen::Vector2d> positions;  ///< [m] all of the world, in the sensor's frame
  std::vector<bool> to_be_found;           ///< of each, whether enough of both walls is seen
};

[[nodiscard]] CornerTruth corner_truth(const World& world, const Pose2& pose, std::size_t rays,
                                       const SeenWalls& seen = {});

/// How true the covariances of what was found of one true corner are.
struct CornerCoverage {
  std::size_t observations = 0;
  std::size_t covered = 0;            ///< inside their 95 % ellipse
  std::size_t beyond_four_sigma = 0;  ///< outside their four-sigma ellipse

  [[nodiscard]] double coverage() const {
    return observations > 0 ? static_cast<double>(covered) / static_cast<double>(observations)
                            : 0.0;
  }
};

/// How well the corners of simulated scans are found. A found corner near no true one is false; it
/// counts in the precision, not in the coverage.
struct CornerQuality {
  std::size_t scans = 0;
  std::size_t true_corners = 0;         ///< to be found, over all scans
  std::size_t found_corners = 0;        ///< over all scans
  std::size_t false_corners = 0;        ///< of the found ones
  Interval recall;                      ///< share of the true ones that were found
  Interval precision;                   ///< share of the found ones that are true
  Interval coverage;                    ///< share of the true found ones in their 95 % ellipse
  Interval nees;                        ///< of those within four sigma; 2 is right
  double beyond_four_sigma = 0.0;       ///< share of the true found ones
  std::vector<CornerCoverage> corners;  ///< one for each true corner, whether to be found or not

  [[nodiscard]] double false_per_100_scans() const {
    return scans > 0 ? 100.0 * static_cast<double>(false_corners) / static_cast<double>(scans)
                     : 0.0;
  }
};

/// Collects the quality of corners scan by scan.
class CornerTally {
 public:
  /// The corners of the scans that follow are not those of the scans before.
  void begin_world() { first_corner_ = corners_.size(); }
  /// What was found in one scan of the present world.
  void add(const std::vector<Corner>& found, const CornerTruth& truth);
  [[nodiscard]] CornerQuality quality() const;

 private:
  std::size_t scans_ = 0;
  ClusteredProportion recall_, precision_, coverage_;
  MeanSums nees_;
  std::size_t beyond_ = 0;
  std::size_t first_corner_ = 0;  // of the present world
  std::vector<CornerCoverage> corners_;
};

/// An empty room of 5 x 3.5 m from places at least 0.4 m from its walls: all four corners are to be
/// found.
[[nodiscard]] CornerQuality judge_room_corners(Extraction& extraction,
                                               const DisturbedScans& disturbed);

/// A column of this radius [m], its surface at this distance [m], and nothing else: it has no
/// corners.
[[nodiscard]] CornerQuality judge_column(Extraction& extraction, double radius, double distance,
                                         const DisturbedScans& disturbed);

}  // namespace quoin
