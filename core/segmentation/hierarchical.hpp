// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "core/segmentation/runs.hpp"
#include "core/segmentation/segment_builder.hpp"

namespace quoin {

/// Clusters on two levels (Opromolla et al. 2017). First, on top of the shared break points, the
/// surface breaks between points farther apart than `cluster_distance`. Second, it breaks where the
/// derivative of one of two functions of the bearing has a local peak above its mean and one
/// standard deviation over the cluster. What is then elongated enough by its principal axes is a
/// line; adjacent lines are joined by the shared merging, which compares with the tolerance of all
/// points instead of the paper's equal directions.
///
/// The two functions are a reconstruction, because the equations are missing from the text at hand:
/// the slopes dx/dtheta and dy/dtheta. Their derivatives peak at every corner; those of x and y
/// themselves do not where a corner points at the sensor. The derivative is the difference of the
/// slopes on both sides of a point, and what noise explains is no peak.
class Hierarchical {
 public:
  static constexpr const char* name = "hierarchical";
  static constexpr const char* description =
      "hierarchical clusters: splits at gaps, then where the slopes of x and y change";
  static constexpr const char* source = "Opromolla et al. 2017 (derivatives reconstructed)";
  static constexpr const char* choose =
      "At up to 10 mm when false segments must be as few as possible and a missed wall does not "
      "matter. Not from 20 mm on, where it misses walls, and at 50 mm nearly all: its limits do "
      "not grow with the noise.";

  struct Parameters : SegmentationParameters {
    double cluster_distance = 0.15;  // [m]
    int slope_points = 6;
    double eigenvalue_ratio = 50.0;

    static constexpr auto fields() {
      using P = Parameters;
      return std::tuple_cat(
          std::make_tuple(
              field<P, double>(&P::cluster_distance, "cluster_distance", "m", 0.001, 100.0,
                               "neighbours farther apart break the surface; raised to twice the "
                               "spacing on a wall that is faced squarely"),
              field<P, int>(&P::slope_points, "slope_points", "", 1, 1000,
                            "points on either side of a point that give the slopes there"),
              field<P, double>(&P::eigenvalue_ratio, "eigenvalue_ratio", "", 1.0, 1e6,
                               "least ratio of the variances along and across a line")),
          common_fields<P>());
    }
  };

  Hierarchical() : Hierarchical(Parameters{}) {}
  explicit Hierarchical(const Parameters& parameters);

  void operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found);

 private:
  void split_at_gaps(const PointsView& points, const Segment& cluster);
  void split_at_slopes(const PointsView& points, const Segment& cluster);
  void compute_changes(const PointsView& points, const Segment& cluster);
  void add(const PointsView& points, const Segment& piece);

  Parameters parameters_;
  SegmentBuilder builder_;
  PrefixMoments moments_;
  std::vector<double> change_x_, change_y_;  // [m/rad] of the slopes at each point
};

}  // namespace quoin
