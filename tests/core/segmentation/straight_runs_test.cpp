// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/straight_runs.hpp"

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

std::vector<Segment> runs_of(const Points& points, const Segment& piece) {
  PrefixMoments moments;
  moments.assign(points);
  StraightRuns runs;
  const auto found = runs.find(points, moments, piece, Tolerance({}, {0.0, 0.0, 0.0}, points));
  return {found.begin(), found.end()};
}

TEST(StraightRuns, LeaveAStraightPieceWhole) {
  const Points points = exact_wall_points({0.3, 2.0}, -0.5, 0.9, 100);
  EXPECT_THAT(runs_of(points, {0, 100}), testing::ElementsAre(Segment{0, 100}));
  EXPECT_THAT(runs_of(points, {20, 90}), testing::ElementsAre(Segment{20, 90}));
}

TEST(StraightRuns, AreNothingWithoutALine) {
  const Points points = points_from({0.1, 0.1, 0.1, 0.1}, {1.0, 1.0, 1.0, 1.0});
  EXPECT_TRUE(runs_of(points, {0, 4}).empty());
  EXPECT_TRUE(runs_of(points, {2, 2}).empty());
}

TEST(StraightRuns, TakeAnArcApart) {
  std::vector<double> bearings;
  for (int i = 0; i < 300; ++i) bearings.push_back(0.01 * i);
  const Points points = points_from(bearings, std::vector<double>(300, 2.0));
  const auto runs = runs_of(points, {0, 300});
  // A chord that is 5 cm off its arc on both sides has a height of 10 cm: 2 acos(1 - 0.1 / 2) =
  // 0.64 rad, and none can be longer. The arc is 3 rad.
  EXPECT_GE(runs.size(), 5U);
  std::size_t free_from = 0;
  for (const Segment& run : runs) {
    EXPECT_GE(run.begin, free_from);
    EXPECT_GE(run.size(), 3U);
    EXPECT_LE(run.size(), 66U);
    free_from = run.end;
  }
  EXPECT_LE(free_from, 300U);
}

}  // namespace
}  // namespace quoin
