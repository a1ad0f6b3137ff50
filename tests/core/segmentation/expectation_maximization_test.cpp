// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/expectation_maximization.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

constexpr std::size_t window = 10;

struct Fitted {
  LineMixture mixture;
  std::vector<std::size_t> labels;
};

Fitted fitted(const Points& points, int steps, const SensorModel& sensor = {}) {
  const Tolerance tolerance({}, sensor, points);
  PrefixMoments moments;
  moments.assign(points);
  Fitted result;
  result.mixture.start(points, {0, points.size()}, moments, tolerance, window);
  for (int k = 0; k < steps; ++k) result.mixture.step(points, tolerance, 3.0);
  result.mixture.label(points, tolerance, result.labels);
  return result;
}

TEST(LineMixture, StartsFromTheStraightWindows) {
  const Points wall = exact_wall_points({0.0, 2.0}, -0.5, 0.5, 100);
  EXPECT_EQ(fitted(wall, 0).mixture.lines(), 10U);
  Points bumped = wall;
  bumped.x[34] += 0.3;
  EXPECT_EQ(fitted(bumped, 0).mixture.lines(), 9U);
  EXPECT_EQ(fitted(points_from({0.1}, {1.0}), 0).mixture.lines(), 0U);
}

TEST(LineMixture, JoinsWhatOneLineExplains) {
  std::mt19937_64 engine(3);
  const Points points = wall_points({0.4, 2.0}, -0.3, 1.1, 200, SensorModel{}, engine);
  const Fitted result = fitted(points, 8);
  ASSERT_EQ(result.mixture.lines(), 1U);
  EXPECT_THAT(result.labels, testing::Each(0U));
  // The noise of 1 cm across the line averages out over 200 points: to 0.7 mm at the middle, and
  // 1 cm / (sqrt(200) 0.5 m), the spread along the line, in the direction; 4 times that.
  const NormalLine& line = result.mixture.line(0);
  const double sign = line.offset < 0.0 ? -1.0 : 1.0;
  EXPECT_NEAR(sign * line.offset, 2.0, 0.004);
  EXPECT_NEAR(std::atan2(sign * line.normal_y, sign * line.normal_x), 0.4, 0.006);
}

TEST(LineMixture, PutsEachPointOnTheWallItIsOn) {
  const Eigen::Vector2d corner(2.0, 2.0);
  const Points points = polyline_points({{2.0, -1.0}, corner, {-1.0, 2.0}});
  const Fitted result = fitted(points, 15);
  ASSERT_EQ(result.mixture.lines(), 2U);
  const std::size_t vertex = nearest_point(points, corner);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Near the corner a point may as well be on the other.
    if (i + 4 > vertex && i < vertex + 4) continue;
    EXPECT_EQ(result.labels[i], i < vertex ? 0U : 1U) << i;
  }
}

TEST(LineMixture, LeavesTheRestToTheBackground) {
  Points points = exact_wall_points({0.0, 2.0}, -0.5, 0.5, 100);
  for (const std::size_t i : {20U, 55U, 77U}) points.x[i] += 0.06;  // the tolerance is 5 cm
  const Fitted result = fitted(points, 8, {0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool off = i == 20 || i == 55 || i == 77;
    EXPECT_EQ(result.labels[i] == LineMixture::background, off) << i;
  }
}

ExpectationMaximization::Parameters bare() {
  ExpectationMaximization::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

TEST(ExpectationMaximization, NeedsNoMergingForARoom) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto segments =
        segments_by<ExpectationMaximization>(noisy_points("square_room", seed), bare());
    EXPECT_EQ(long_ones(segments, 200).size(), 4U) << seed;
  }
}

TEST(ExpectationMaximization, GivesTheRunsOfALineOneByOne) {
  // A box of 12 cm before a wall; both sides of the wall are explained by one line.
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 120; ++i) {
    bearings.push_back(-0.6 + 0.01 * i);
    ranges.push_back((i >= 48 && i < 72 ? 1.88 : 2.0) / std::cos(bearings.back()));
  }
  auto parameters = bare();
  parameters.breakpoint_angle = 0.02;
  EXPECT_THAT(segments_by<ExpectationMaximization>(points_from(bearings, ranges), parameters),
              testing::ElementsAre(Segment{0, 48}, Segment{48, 72}, Segment{72, 120}));
}

TEST(ExpectationMaximization, ConvergesToTheWallsFromLargerWindows) {
  const Points points = noisy_points("square_room", 6);
  auto parameters = bare();
  parameters.lines = 12;  // windows of 77 points
  EXPECT_EQ(long_ones(segments_by<ExpectationMaximization>(points, parameters), 200).size(), 4U);
  parameters.lines = 1;  // one line through a room is not straight: nothing to start from
  EXPECT_TRUE(segments_by<ExpectationMaximization>(points, parameters).empty());
}

}  // namespace
}  // namespace quoin
