// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/hierarchical.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

Hierarchical::Parameters bare() {
  Hierarchical::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

/// A wall at 3 m without points 25 to 31: a gap of 0.24 m, which is 8 steps of the bearing.
Points wall_with_a_gap() {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 60; ++i) {
    if (i >= 25 && i < 32) continue;
    bearings.push_back(-0.3 + 0.01 * i);
    ranges.push_back(3.0 / std::cos(bearings.back()));
  }
  return points_from(bearings, ranges);
}

/// A step of 0.2 m between points 29 and 30.
Points stepped_wall() {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 60; ++i) {
    bearings.push_back(-0.3 + 0.01 * i);
    ranges.push_back((i < 30 ? 3.0 : 3.2) / std::cos(bearings.back()));
  }
  return points_from(bearings, ranges);
}

TEST(Hierarchical, BreaksAtStepsFartherThanTheClusterDistance) {
  auto parameters = bare();
  parameters.breakpoint_angle = 0.02;  // the shared break points see none
  EXPECT_THAT(segments_by<Hierarchical>(stepped_wall(), parameters),
              testing::ElementsAre(Segment{0, 30}, Segment{30, 60}));
}

TEST(Hierarchical, RaisesTheClusterDistanceToTheSpacing) {
  // Twice the spacing of the rays next to the gap is 0.48 m: rays that are missing are no break.
  EXPECT_THAT(segments_by<Hierarchical>(wall_with_a_gap(), bare()),
              testing::ElementsAre(Segment{0, 53}));
}

TEST(Hierarchical, SplitsWhereTheSlopesChangeMost) {
  // A corner that points away from the sensor and one towards it.
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Vector2d corner(2.0, 0.2);
    const Points points = polyline_points(
        {corner + Eigen::Vector2d(sign, -1.0), corner, corner + Eigen::Vector2d(sign, 1.2)});
    const auto segments = segments_by<Hierarchical>(points, bare(), {0.0, 0.0, 0.0});
    ASSERT_EQ(segments.size(), 2U) << sign;
    EXPECT_NEAR(static_cast<double>(segments[0].end),
                static_cast<double>(nearest_point(points, corner)), 1.0);
    EXPECT_EQ(segments[0].end, segments[1].begin);
  }
}

TEST(Hierarchical, WantsElongatedClusters) {
  // A wall of 2 m with a noise of 1 cm: the ratio of variances is about 2^2 / 12 / 0.01^2 = 3300,
  // and from 150 points it is known to 12 % (one standard deviation). The sensor model says three
  // times the noise, so that no change of slope is more than noise explains.
  std::mt19937_64 engine(2);
  const double half = std::atan(0.5);
  const Points points = wall_points({0.0, 2.0}, -half, half, 150, {0.01, 0.0, 0.0}, engine);
  auto parameters = bare();
  const SensorModel sensor{0.03, 0.0, 0.0};
  parameters.eigenvalue_ratio = 1800.0;
  EXPECT_THAT(segments_by<Hierarchical>(points, parameters, sensor),
              testing::ElementsAre(Segment{0, 150}));
  parameters.eigenvalue_ratio = 6000.0;
  EXPECT_TRUE(segments_by<Hierarchical>(points, parameters, sensor).empty());
}

TEST(Hierarchical, DoesNotMindWhereTheBearingIsWrapped) {
  const Points points = exact_wall_points({3.1, 2.0}, 2.6, 3.7, 120);
  Points wrapped = points;
  for (double& bearing : wrapped.bearing) bearing -= bearing > 3.14159265 ? 6.28318531 : 0.0;
  EXPECT_EQ(segments_by<Hierarchical>(wrapped), segments_by<Hierarchical>(points));
  EXPECT_THAT(segments_by<Hierarchical>(wrapped, bare()), testing::ElementsAre(Segment{0, 120}));
}

}  // namespace
}  // namespace quoin
