// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/runs.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

TEST(SquaredMahalanobis, IsChiSquareForOneWall) {
  // Faced squarely, so that a tolerance is 4 standard deviations of the range for all points.
  SegmentationParameters parameters;
  parameters.split_distance = 0.001;
  const SensorModel sensor{0.02, 0.0, 0.0};
  std::mt19937_64 engine(6);
  const int trials = 2000;
  double sum = 0.0;
  for (int k = 0; k < trials; ++k) {
    const Points points = wall_points({0.0, 20.0}, -0.05, 0.05, 40, sensor, engine);
    PrefixMoments moments;
    moments.assign(points);
    const auto distance =
        squared_mahalanobis(moments(0, 20), moments(20, 40), {parameters, sensor, points});
    ASSERT_TRUE(distance);
    sum += *distance;
  }
  // Two degrees of freedom: mean 2, variance 4. Four standard deviations of the mean.
  EXPECT_NEAR(sum / trials, 2.0, 4.0 * std::sqrt(4.0 / trials));
}

TEST(SquaredMahalanobis, IsLargeForTwoWalls) {
  const Points points = exact_wall_points({0.0, 2.0}, -0.3, 0.3, 40);
  const Points other = exact_wall_points({1.2, 2.0}, 0.3, 0.9, 40);
  PrefixMoments first;
  PrefixMoments second;
  first.assign(points);
  second.assign(other);
  const Tolerance tolerance({}, {}, points);
  const auto distance = squared_mahalanobis(first(0, 40), second(0, 40), tolerance);
  ASSERT_TRUE(distance);
  EXPECT_GT(*distance, 100.0);
  EXPECT_FALSE(squared_mahalanobis(Moments{}, Moments{}, tolerance));
}

std::vector<std::size_t> peaks(const std::vector<double>& values, const Segment& range,
                               std::size_t reach, double limit) {
  std::vector<std::size_t> found;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (is_peak(values, range, i, reach, limit)) found.push_back(i);
  }
  return found;
}

TEST(IsPeak, IsTheLargestNearby) {
  const std::vector<double> values{0, 3, 1, 2, 0, 0, 5, 5, 4, 6};
  EXPECT_THAT(peaks(values, {0, 10}, 1, 0.0), testing::ElementsAre(1, 3, 6, 9));
  EXPECT_THAT(peaks(values, {0, 10}, 2, 0.0), testing::ElementsAre(1, 6, 9));
  EXPECT_THAT(peaks(values, {0, 10}, 20, 0.0), testing::ElementsAre(9));
}

TEST(IsPeak, IsAboveTheLimit) {
  EXPECT_THAT(peaks({0, 3, 1, 2, 0}, {0, 5}, 1, 2.0), testing::ElementsAre(1));
  EXPECT_THAT(peaks({0, 0, 0}, {0, 3}, 1, 0.0), testing::ElementsAre());
}

TEST(IsPeak, LooksInsideTheRangeOnly) {
  EXPECT_THAT(peaks({9, 1, 2, 1, 9}, {1, 4}, 3, 0.0), testing::ElementsAre(2));
  EXPECT_THAT(peaks({4, 4, 4, 4}, {0, 4}, 3, 0.0), testing::ElementsAre(0));  // the first of equals
}

const NormalLine wall{1.0, 0.0, 2.0};

/// 40 points of the wall x = 2 m, these of them moved by so much [m].
Points wall_with(const std::vector<std::size_t>& moved, double offset) {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (std::size_t i = 0; i < 40; ++i) {
    bearings.push_back(-0.2 + 0.01 * static_cast<double>(i));
    ranges.push_back(2.0 / std::cos(bearings.back()));
  }
  for (const std::size_t i : moved) ranges[i] = (2.0 + offset) / std::cos(bearings[i]);
  return points_from(bearings, ranges);
}

/// 5 cm for every point.
Tolerance five_centimetres(const Points& points) { return {{}, {0.0, 0.0, 0.0}, points}; }

Segment run_in(const Points& points, const Segment& range, std::size_t inside) {
  return run_around(points, range, inside, wall, five_centimetres(points));
}

TEST(ExcessOf, IsTheSquaredDistanceInTolerances) {
  const Points points = wall_with({7}, 0.1);
  EXPECT_NEAR(excess_of(wall, points, 7, five_centimetres(points)), 4.0, 1e-9);
  EXPECT_NEAR(excess_of(wall, points, 8, five_centimetres(points)), 0.0, 1e-9);
  // 4 standard deviations of 5 cm along a ray that meets the wall at an angle of -0.13 rad.
  const Tolerance noisy({}, {0.05, 0.0, 0.0}, points);
  EXPECT_NEAR(excess_of(wall, points, 7, noisy), std::pow(0.1 / 0.2 / std::cos(0.13), 2), 1e-9);
}

TEST(RunAround, PassesOverPairsOfMildOutliers) {
  const Segment all{0, 40};
  EXPECT_EQ(run_in(wall_with({20}, 0.09), all, 5), all);
  EXPECT_EQ(run_in(wall_with({20, 21}, 0.09), all, 5), all);
  EXPECT_EQ(run_in(wall_with({20, 21}, 0.09), all, 30), all);
  EXPECT_EQ(run_in(wall_with({20, 21, 22}, 0.09), all, 5), Segment(0, 20));
  EXPECT_EQ(run_in(wall_with({20, 21, 22}, 0.09), all, 30), Segment(23, 40));
}

TEST(RunAround, EndsAtGrossOutliersAndAtTheRange) {
  EXPECT_EQ(run_in(wall_with({20}, 0.11), {0, 40}, 5), Segment(0, 20));
  EXPECT_EQ(run_in(wall_with({}, 0.0), {3, 17}, 5), Segment(3, 17));
  EXPECT_EQ(run_in(wall_with({3, 16}, 0.09), {3, 17}, 5), Segment(4, 16));  // not at the ends
  EXPECT_EQ(run_in(wall_with({5}, 0.09), {3, 17}, 5).size(), 0U);
}

TEST(LongestRun, IsTheOneWithMostPoints) {
  const Points points = wall_with({9, 25}, 0.3);
  const Tolerance tolerance = five_centimetres(points);
  EXPECT_EQ(longest_run(points, {0, 40}, wall, tolerance), Segment(10, 25));
  EXPECT_EQ(longest_run(points, {20, 40}, wall, tolerance), Segment(26, 40));
  EXPECT_EQ(longest_run(points, {0, 40}, {1.0, 0.0, 1.0}, tolerance).size(), 0U);
}

TEST(RefinedRun, GrowsOverTheWall) {
  const Points points = exact_wall_points({0.2, 2.0}, -0.8, 1.0, 200);
  PrefixMoments moments;
  moments.assign(points);
  const Tolerance tolerance = five_centimetres(points);
  EXPECT_EQ(refined_run(points, moments, {0, 200}, {90, 110}, tolerance), Segment(0, 200));
  EXPECT_EQ(refined_run(points, moments, {50, 120}, {90, 110}, tolerance), Segment(50, 120));
  EXPECT_EQ(refined_run(points, moments, {50, 120}, {90, 90}, tolerance).size(), 0U);
}

TEST(StraightRun, IsWhatIsStraightOfAPiece) {
  const Points whole = exact_wall_points({0.2, 2.0}, -0.8, 1.0, 200);
  PrefixMoments moments;
  moments.assign(whole);
  EXPECT_EQ(straight_run(whole, moments, {10, 190}, five_centimetres(whole)), Segment(10, 190));

  const Points bumped = wall_with({30, 31, 32, 33}, 0.3);
  moments.assign(bumped);
  EXPECT_EQ(straight_run(bumped, moments, {0, 40}, five_centimetres(bumped)), Segment(0, 30));

  const Points equal = points_from({0.1, 0.1, 0.1}, {1.0, 1.0, 1.0});
  moments.assign(equal);
  EXPECT_EQ(straight_run(equal, moments, {0, 3}, five_centimetres(equal)).size(), 0U);
}

std::vector<Segment> straight_runs_of(const Points& points, const Segment& piece) {
  PrefixMoments moments;
  moments.assign(points);
  StraightRuns runs;
  const auto found = runs.find(points, moments, piece, Tolerance({}, {0.0, 0.0, 0.0}, points));
  return {found.begin(), found.end()};
}

TEST(StraightRuns, LeaveAStraightPieceWhole) {
  const Points points = exact_wall_points({0.3, 2.0}, -0.5, 0.9, 100);
  EXPECT_THAT(straight_runs_of(points, {0, 100}), testing::ElementsAre(Segment{0, 100}));
  EXPECT_THAT(straight_runs_of(points, {20, 90}), testing::ElementsAre(Segment{20, 90}));
}

TEST(StraightRuns, AreNothingWithoutALine) {
  const Points points = points_from({0.1, 0.1, 0.1, 0.1}, {1.0, 1.0, 1.0, 1.0});
  EXPECT_TRUE(straight_runs_of(points, {0, 4}).empty());
  EXPECT_TRUE(straight_runs_of(points, {2, 2}).empty());
}

TEST(StraightRuns, TakeAnArcApart) {
  std::vector<double> bearings;
  for (int i = 0; i < 300; ++i) bearings.push_back(0.01 * i);
  const Points points = points_from(bearings, std::vector<double>(300, 2.0));
  const auto runs = straight_runs_of(points, {0, 300});
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
