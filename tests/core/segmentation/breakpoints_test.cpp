// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/breakpoints.hpp"

#include <cmath>
#include <cstddef>

#include <gmock/gmock.h>

#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

using testing::ElementsAre;

constexpr double ten_degrees = 0.17453292519943295;

std::vector<Segment> clusters_of(const std::vector<double>& bearings,
                                 const std::vector<double>& ranges, bool& break_at_seam) {
  CoarsePoints coarse;
  coarse.assign(points_from(bearings, ranges));
  std::vector<Segment> clusters;
  break_at_seam = BreakpointDetector(ten_degrees, 0.4).find(coarse, SensorModel{}, clusters);
  return clusters;
}

TEST(BreakpointDetector, BreaksWhereTheRangeJumps) {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 360; ++i) {
    bearings.push_back(i * 0.0174532925);
    ranges.push_back(i < 75 || i >= 140 ? 2.0 : 2.6);
  }
  bool break_at_seam = true;
  EXPECT_THAT(clusters_of(bearings, ranges, break_at_seam),
              ElementsAre(Segment{0, 75}, Segment{75, 140}, Segment{140, 360}));
  EXPECT_FALSE(break_at_seam);
  ranges[359] = 3.0;
  EXPECT_THAT(clusters_of(bearings, ranges, break_at_seam),
              ElementsAre(Segment{0, 75}, Segment{75, 140}, Segment{140, 359}, Segment{359, 360}));
  EXPECT_TRUE(break_at_seam);
}

TEST(BreakpointDetector, BreaksAtStepsOfLambdaAndBeyondAnyRange) {
  bool break_at_seam = false;
  EXPECT_THAT(clusters_of({0.0, 0.01, 0.02, 0.22}, {2.0, 2.0, 2.0, 2.0}, break_at_seam),
              ElementsAre(Segment{0, 3}, Segment{3, 4}));
  EXPECT_TRUE(break_at_seam);
  // Of a sensor whose rays are as far apart, it is the next.
  EXPECT_THAT(clusters_of({0.0, 0.2, 0.4, 0.6}, {2.0, 2.0, 2.0, 2.0}, break_at_seam),
              ElementsAre(Segment{0, 4}));
  EXPECT_THAT(clusters_of({0.0, 0.01}, {1e12, 1e13}, break_at_seam),
              ElementsAre(Segment{0, 1}, Segment{1, 2}));
}

// The distance at a grazing angle grows beyond all bounds where the step nears that angle.
TEST(BreakpointDetector, BreaksWhereRaysAreMissingBetweenThingsApart) {
  bool break_at_seam = false;
  const std::vector<double> bearings{0.0, 0.01, 0.02, 0.18, 0.19, 0.2};
  EXPECT_THAT(clusters_of(bearings, {4.5, 4.5, 4.5, 1.6, 1.6, 1.6}, break_at_seam),
              ElementsAre(Segment{0, 3}, Segment{3, 6}));
  EXPECT_THAT(clusters_of(bearings, {1.6, 1.6, 1.6, 1.6, 1.6, 1.6}, break_at_seam),
              ElementsAre(Segment{0, 6}));
}

TEST(BreakpointDetector, KeepsEqualPointsTogether) {
  bool break_at_seam = true;
  EXPECT_THAT(clusters_of({0.2, 0.2}, {1.0, 1.0}, break_at_seam), ElementsAre(Segment{0, 2}));
  EXPECT_FALSE(break_at_seam);
  EXPECT_THAT(clusters_of({}, {}, break_at_seam), ElementsAre());
}

}  // namespace
}  // namespace quoin
