// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/corners/adjacent.hpp"

#include "core/corners/corner_finders.hpp"
#include "tests/core/matchers.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

LineSegment segment(double alpha, double r, Eigen::Vector2d start, Eigen::Vector2d end) {
  return {{{alpha, r}, Eigen::Matrix2d{{1e-5, 0.0}, {0.0, 1e-5}}}, start, end};
}

std::vector<LineSegment> room() {
  return {segment(0.0, 2.0, {2.0, -1.9}, {2.0, 1.9}), segment(pi / 2, 2.0, {1.9, 2.0}, {-1.9, 2.0}),
          segment(pi, 2.0, {-2.0, 1.9}, {-2.0, -1.9}),
          segment(-pi / 2, 2.0, {-1.9, -2.0}, {1.9, -2.0})};
}

TEST(Adjacent, FindsTheCornersOfARoomAcrossTheSeam) {
  FoundCorners found;
  const std::vector<Corner>& corners = found.corners;
  Adjacent{}(room(), 0.0, found);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_NEAR((corners[0].estimate.position - Eigen::Vector2d(2.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(corners[3].first_line, 3U);
  EXPECT_EQ(corners[3].second_line, 0U);
  EXPECT_NEAR(corners[0].angle, pi / 2, 1e-6);
  EXPECT_NEAR(corners[0].gap, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(corners[0].extrapolation, 0.1, 1e-12);
}

TEST(Adjacent, GatesByGapExtrapolationAndAngle) {
  FoundCorners found;
  const std::vector<Corner>& corners = found.corners;
  Adjacent::Parameters parameters;
  parameters.max_gap = 0.13;
  Adjacent{parameters}(room(), 0.0, found);
  EXPECT_TRUE(corners.empty());
  parameters = {};
  parameters.max_extrapolation = 0.09;
  Adjacent{parameters}(room(), 0.0, found);
  EXPECT_TRUE(corners.empty());
  const std::vector<LineSegment> shallow{segment(0.0, 2.0, {2.0, -1.0}, {2.0, 0.0}),
                                         segment(0.3, 1.91, {2.0, 0.0}, {1.7, 1.0})};
  Adjacent{}(shallow, 0.0, found);
  EXPECT_TRUE(corners.empty());
  parameters = {};
  parameters.min_angle = 0.25;
  Adjacent{parameters}(shallow, 0.0, found);
  EXPECT_EQ(corners.size(), 1U);
}

TEST(Adjacent, GivesTheCornerOfTwoLinesOnce) {
  const std::vector<LineSegment> lines = room();
  FoundCorners found;
  const std::vector<Corner>& corners = found.corners;
  Adjacent{}(std::span(lines).subspan(0, 2), 0.0, found);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0].first_line, 0U);
  const std::vector<LineSegment> turned{lines[1], lines[0]};
  Adjacent{}(turned, 0.0, found);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0].first_line, 1U);
  Adjacent{}(std::span(lines).subspan(0, 1), 0.0, found);
  EXPECT_TRUE(corners.empty());
}

// Walls of a corridor: the last ray on the side wall is 1.6 m before the end wall.
TEST(Adjacent, TakesCornersThatAreWithinTheRaysOfTheSensor) {
  std::vector<LineSegment> lines{segment(-pi / 2, 1.0, {0.0, -1.0}, {10.4, -1.0}),
                                 segment(0.0, 12.0, {12.0, -0.84}, {12.0, 0.42})};
  FoundCorners found;
  Adjacent{}(lines, 0.0, found);
  EXPECT_TRUE(found.corners.empty());
  ASSERT_EQ(found.without.size(), 2U);
  EXPECT_EQ(found.without[0].reason, NoCornerReason::wide_gap);
  lines[0].points = 170;  // half a degree apart
  lines[1].points = 13;
  Adjacent{}(lines, 0.0, found);
  ASSERT_EQ(found.corners.size(), 1U);
  EXPECT_TRUE(found.corners[0].seen);
  EXPECT_NEAR(found.corners[0].estimate.position.x(), 12.0, 1e-9);
  EXPECT_NEAR(found.corners[0].extrapolation, 1.6, 1e-9);
}

// The face of a cupboard ends at x = 1 before a wall that is seen on both sides of the line of that
// face: it passes behind, and they meet nowhere.
TEST(Adjacent, TakesNoCornerInsideAWallThatGoesOn) {
  std::vector<LineSegment> lines{segment(pi / 4, 2.0, {2.0, 0.82}, {1.5, 1.32}),
                                 segment(pi / 2, 1.6, {1.8, 1.6}, {-1.0, 1.6})};
  for (LineSegment& line : lines) line.points = 60;
  Adjacent::Parameters parameters;
  parameters.max_gap = parameters.max_extrapolation = 5.0;
  FoundCorners found;
  Adjacent{parameters}(std::span(lines), 0.0, found);
  EXPECT_TRUE(found.corners.empty());
  ASSERT_EQ(found.without.size(), 2U);
  EXPECT_EQ(found.without[0].reason, NoCornerReason::inside_line);
  // Where it begins at the face, or within what its bearing is known to, it is a corner.
  lines[1].start.x() = 1.23;
  Adjacent{parameters}(std::span(lines), 0.0, found);
  EXPECT_FALSE(found.corners.empty());
  lines[1].start.x() = 1.27;
  lines[0].estimate.covariance *= 100.0;
  Adjacent{parameters}(std::span(lines), 0.0, found);
  EXPECT_FALSE(found.corners.empty());
}

TEST(Adjacent, TellsCornersOfARoomFromThoseOfABox) {
  FoundCorners found;
  Adjacent{}(room(), 0.0, found);
  EXPECT_NEAR(found.corners[0].opening, pi / 2, 1e-9);
  const std::vector<LineSegment> faces{segment(pi / 4, 2.0, {3.33, -0.5}, {2.83, 0.0}),
                                       segment(-pi / 4, 2.0, {2.83, 0.0}, {3.33, 0.5})};
  Adjacent{}(faces, 0.0, found);
  ASSERT_EQ(found.corners.size(), 1U);
  EXPECT_NEAR(found.corners[0].opening, 3 * pi / 2, 1e-2);
  EXPECT_NEAR(found.corners[0].angle, pi / 2, 1e-9);
}

TEST(Adjacent, AddsTheRangeBiasWhenAsked) {
  FoundCorners with;
  FoundCorners without;
  const CornerFinder finder = CornerFinders::make<CornerFinder>("adjacent", {});
  finder(room(), 0.05, with);
  CornerFinders::make<CornerFinder>("adjacent", {{"include_range_bias", "false"}})(room(), 0.05,
                                                                                   without);
  EXPECT_NEAR((with.corners[0].estimate.covariance - without.corners[0].estimate.covariance)(0, 1),
              0.00125, 1e-12);
}

}  // namespace
}  // namespace quoin
