// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/runs.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

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

}  // namespace
}  // namespace quoin
