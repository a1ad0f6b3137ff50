// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/line_alignment.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

/// Walls of a polyline, seen from the left of the way from point to point.
std::vector<SidedSegment> seen(const std::vector<Eigen::Vector2d>& points) {
  std::vector<SidedSegment> segments;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d along = points[(i + 1) % points.size()] - points[i];
    segments.push_back(
        {std::atan2(-along.x(), along.y()), points[i] + 0.5 * along, 0.5 * along.norm()});
  }
  return segments;
}

std::vector<SidedSegment> from(const Pose2& pose, std::vector<SidedSegment> segments) {
  for (SidedSegment& segment : segments) {
    segment.middle = pose.inverse_transform(segment.middle);
    segment.normal = normalized_angle(segment.normal - pose.theta);
  }
  return segments;
}

const std::vector<Eigen::Vector2d> niche{{0, 0}, {5, 0}, {5, 3}, {3, 3}, {3, 4}, {0, 4}};

TEST(Alignment, FindsThePoseInARoomWithoutSymmetry) {
  const auto map = seen(niche);
  const Pose2 truth{1.7, 1.2, 2.6};
  const auto found = align(from(truth, map), map, {});
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].pose.x, truth.x, 1e-6);
  EXPECT_NEAR(found[0].pose.y, truth.y, 1e-6);
  EXPECT_NEAR(normalized_angle(found[0].pose.theta - truth.theta), 0.0, 1e-6);
  EXPECT_EQ(found[0].pairs.size(), 6U);
  EXPECT_NEAR(found[0].support, 18.0, 1e-6);
  ASSERT_GT(found.size(), 1U);
  EXPECT_LT(found[1].support, 0.75 * found[0].support);
}

TEST(Alignment, FindsBothOfTwoRoomsAlike) {
  auto map = seen(niche);
  const auto scan = from({1.0, 1.0, 0.0}, map);
  for (const SidedSegment& segment : seen(niche)) {
    map.push_back(segment);
    map.back().middle.x() += 20.0;
  }
  const auto found = align(scan, map, {});
  ASSERT_GE(found.size(), 2U);
  EXPECT_NEAR(found[1].support, found[0].support, 1e-6);
  EXPECT_NEAR(std::abs(found[1].pose.x - found[0].pose.x), 20.0, 1e-6);
}

TEST(Alignment, StaysInsideOfTheSearch) {
  const auto map = seen(niche);
  AlignmentSearch search;
  search.center = {1.0, 1.0, 0.0};
  search.largest_translation = 0.2;
  search.largest_turn = 0.2;
  EXPECT_TRUE(align(from({1.15, 0.9, 0.1}, map), map, search).size() == 1);
  EXPECT_TRUE(align(from({1.0, 1.0, 0.5}, map), map, search).empty());
}

TEST(Alignment, KnowsTheSidesOfAWall) {
  auto map = seen(niche);
  const auto scan = from({1.0, 1.0, 0.0}, map);
  for (SidedSegment& segment : map) segment.normal = normalized_angle(segment.normal + pi);
  AlignmentSearch search;
  search.center = {1.0, 1.0, 0.0};
  search.largest_turn = 0.3;
  search.largest_translation = 0.5;
  EXPECT_TRUE(align(scan, map, search).empty());
}

}  // namespace
}  // namespace quoin
