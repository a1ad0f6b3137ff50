// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/split_and_merge.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/segmentation/iepf.hpp"
#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

SplitAndMerge::Parameters bare() {
  SplitAndMerge::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

TEST(SplitAndMerge, SplitsTwoEqualWallsAtTheirCorner) {
  // The fitted line is as far from the outer ends as from the corner: an end must not be the place.
  const Eigen::Vector2d corner(2.0, 2.0);
  const Points points = polyline_points({{2.0, -0.5}, corner, {-0.5, 2.0}});
  const auto segments = segments_by<SplitAndMerge>(points, bare());
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].end, segments[1].begin);
  EXPECT_NEAR(static_cast<double>(segments[0].end),
              static_cast<double>(nearest_point(points, corner)), 1.0);
}

TEST(SplitAndMerge, DoesNotTrustTheEndsOfAPiece) {
  // Both ends are 4 cm behind the wall and one point is 2 cm before it: each is within the
  // tolerance of 5 cm, but the chord is 6 cm from that point.
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 100; ++i) {
    bearings.push_back(-0.5 + 0.01 * i);
    const double more = i == 0 || i == 99 ? 0.04 : i == 50 ? -0.02 : 0.0;
    ranges.push_back((2.0 + more) / std::cos(bearings.back()));
  }
  const Points points = points_from(bearings, ranges);
  EXPECT_THAT(segments_by<SplitAndMerge>(points, bare(), {0.0, 0.0, 0.0}),
              testing::ElementsAre(Segment{0, 100}));
  Iepf::Parameters chord;
  chord.merge = false;
  chord.refine = false;
  EXPECT_EQ(segments_by<Iepf>(points, chord, {0.0, 0.0, 0.0}).size(), 2U);
}

TEST(SplitAndMerge, SplitsDownToTheTolerance) {
  const Points points = polyline_points({{2.0, -1.5}, {2.0, 0.0}, {2.3, 0.0}, {2.3, 1.5}});
  auto parameters = bare();
  EXPECT_EQ(segments_by<SplitAndMerge>(points, parameters).size(), 2U);  // nothing of 0.3 m seen
  const Points step = polyline_points({{2.0, -1.5}, {2.0, 0.0}, {1.88, 0.15}, {1.88, 1.5}});
  EXPECT_EQ(segments_by<SplitAndMerge>(step, parameters).size(), 3U);
  parameters.split_distance = 0.2;
  EXPECT_EQ(segments_by<SplitAndMerge>(step, parameters).size(), 1U);
}

}  // namespace
}  // namespace quoin
