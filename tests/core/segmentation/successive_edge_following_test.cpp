// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/successive_edge_following.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

SuccessiveEdgeFollowing::Parameters bare() {
  SuccessiveEdgeFollowing::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

TEST(SuccessiveEdgeFollowing, FollowsAnInclinedWallWhoseRangesGrowByMoreThanTheTolerance) {
  // Up to 80 deg off the normal: there the range grows by 0.33 m from one point to the next.
  const Points points = exact_wall_points({0.0, 1.0}, 0.0, 1.3962634, 140);
  ASSERT_GT(points.range[139] - points.range[138], 0.3);
  auto parameters = bare();
  parameters.breakpoint_angle = 0.05;
  EXPECT_THAT(segments_by<SuccessiveEdgeFollowing>(points, parameters, {0.0, 0.0, 0.0}),
              testing::ElementsAre(Segment{0, 140}));
}

TEST(SuccessiveEdgeFollowing, StartsASegmentWhereTheRangeSteps) {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 80; ++i) {
    bearings.push_back(0.01 * i);
    ranges.push_back(i < 40 ? 2.0 / std::cos(0.01 * i) : 2.08 / std::cos(0.01 * i));
  }
  const Points points = points_from(bearings, ranges);
  EXPECT_THAT(segments_by<SuccessiveEdgeFollowing>(points, bare()),
              testing::ElementsAre(Segment{0, 40}, Segment{40, 80}));
  // A noisy sensor may see such a step on a wall: 8 cm are 3 standard deviations.
  EXPECT_THAT(segments_by<SuccessiveEdgeFollowing>(points, bare(), {0.027, 0.0, 0.0}),
              testing::ElementsAre(Segment{0, 80}));
}

TEST(SuccessiveEdgeFollowing, FindsACornerWithoutAStep) {
  const Eigen::Vector2d corner(2.0, 2.0);
  const Points points = polyline_points({{2.0, -1.0}, corner, {-1.0, 2.0}});
  const auto segments = segments_by<SuccessiveEdgeFollowing>(points, bare());
  ASSERT_EQ(segments.size(), 2U);
  // Beyond the corner the range falls instead of growing: by 2.8 m times 0.0068 rad twice a point.
  EXPECT_NEAR(static_cast<double>(segments[1].begin),
              static_cast<double>(nearest_point(points, corner)) + 2.0, 2.0);
}

TEST(SuccessiveEdgeFollowing, PredictsFromSoManyPoints) {
  // A bend of 25 deg takes the range off what many points say by the tolerance of 5 cm within 11 cm
  // of the second wall, 8 points; few points bend with it.
  const Points points = polyline_points({{2.0, -1.5}, {2.0, 0.0}, {1.4, 1.29}});
  auto parameters = bare();
  parameters.slope_points = 100;
  const auto by_many = segments_by<SuccessiveEdgeFollowing>(points, parameters, {0.0, 0.0, 0.0});
  ASSERT_EQ(by_many.size(), 2U);
  EXPECT_NEAR(static_cast<double>(by_many[1].begin),
              static_cast<double>(nearest_point(points, {2.0, 0.0})) + 8.0, 2.0);
  parameters.slope_points = 5;
  EXPECT_NE(segments_by<SuccessiveEdgeFollowing>(points, parameters, {0.0, 0.0, 0.0}), by_many);
}

TEST(SuccessiveEdgeFollowing, TakesABowApart) {
  std::vector<double> bearings;
  for (int i = 0; i < 300; ++i) bearings.push_back(0.0035 * i);
  std::vector<double> ranges(300, 2.0);
  for (std::size_t i = 0; i < ranges.size(); i += 2) ranges[i] += 1e-4;  // no fill value
  const Points points = points_from(bearings, ranges);
  auto parameters = bare();
  parameters.max_bend = 1.0;
  const auto segments = segments_by<SuccessiveEdgeFollowing>(points, parameters);
  EXPECT_GE(segments.size(), 2U);
  for (const Segment& segment : segments) EXPECT_LT(segment.size(), 200U);
}

}  // namespace
}  // namespace quoin
