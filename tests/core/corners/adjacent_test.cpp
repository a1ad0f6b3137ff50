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
  std::vector<Corner> corners(3);
  Adjacent{}(room(), 0.0, corners);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_NEAR((corners[0].estimate.position - Eigen::Vector2d(2.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(corners[3].first_line, 3U);
  EXPECT_EQ(corners[3].second_line, 0U);
  EXPECT_NEAR(corners[0].angle, pi / 2, 1e-6);
  EXPECT_NEAR(corners[0].gap, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(corners[0].extrapolation, 0.1, 1e-12);
}

TEST(Adjacent, GatesByGapExtrapolationAndAngle) {
  std::vector<Corner> corners;
  Adjacent::Parameters parameters;
  parameters.max_gap = 0.13;
  Adjacent{parameters}(room(), 0.0, corners);
  EXPECT_TRUE(corners.empty());
  parameters = {};
  parameters.max_extrapolation = 0.09;
  Adjacent{parameters}(room(), 0.0, corners);
  EXPECT_TRUE(corners.empty());
  const std::vector<LineSegment> shallow{segment(0.0, 2.0, {2.0, -1.0}, {2.0, 0.0}),
                                         segment(0.3, 1.91, {2.0, 0.0}, {1.7, 1.0})};
  Adjacent{}(shallow, 0.0, corners);
  EXPECT_TRUE(corners.empty());
  parameters = {};
  parameters.min_angle = 0.25;
  Adjacent{parameters}(shallow, 0.0, corners);
  EXPECT_EQ(corners.size(), 1U);
}

TEST(Adjacent, GivesTheCornerOfTwoLinesOnce) {
  const std::vector<LineSegment> lines = room();
  std::vector<Corner> corners;
  Adjacent{}(std::span(lines).subspan(0, 2), 0.0, corners);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0].first_line, 0U);
  const std::vector<LineSegment> turned{lines[1], lines[0]};
  Adjacent{}(turned, 0.0, corners);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0].first_line, 1U);
  Adjacent{}(std::span(lines).subspan(0, 1), 0.0, corners);
  EXPECT_TRUE(corners.empty());
}

TEST(Adjacent, AddsTheRangeBiasWhenAsked) {
  std::vector<Corner> with;
  std::vector<Corner> without;
  const CornerFinder finder = CornerFinders::make<CornerFinder>("adjacent", {});
  finder(room(), 0.05, with);
  CornerFinders::make<CornerFinder>("adjacent", {{"include_range_bias", "false"}})(room(), 0.05,
                                                                                   without);
  EXPECT_NEAR((with[0].estimate.covariance - without[0].estimate.covariance)(0, 1), 0.00125, 1e-12);
}

}  // namespace
}  // namespace quoin
