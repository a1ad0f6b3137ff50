// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/point_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"
#include "core/mapping/state_archive.hpp"

namespace quoin {
namespace {

/// Points every 3 cm of an L of two walls, 4 m and 3 m long, and of a short one, as a sensor at
/// `pose` sees them.
std::vector<SurfacePoint> seen_from(const Pose2& pose) {
  std::vector<Eigen::Vector2d> points;
  const auto add = [&](double x0, double y0, double x1, double y1) {
    const int steps = static_cast<int>(std::hypot(x1 - x0, y1 - y0) / 0.03);
    for (int i = 0; i <= steps; ++i) {
      const double f = static_cast<double>(i) / steps;
      points.push_back(pose.inverse_transform({x0 + f * (x1 - x0), y0 + f * (y1 - y0)}));
    }
  };
  add(2.0, -2.0, 2.0, 2.0);
  add(2.0, 2.0, -1.0, 2.0);
  add(-1.5, 1.5, -1.5, 0.5);
  std::vector<SurfacePoint> surface;
  surface_points(points, 0.05, 20.0, surface);
  return surface;
}

PointMap map_from_origin() {
  PointMap map;
  map.clear({0.0, 0.0}, 6.0);
  map.add({}, seen_from({}));
  return map;
}

TEST(SurfacePoints, HaveNormalsTowardsTheSensorAndTheirSpacing) {
  const std::vector<SurfacePoint> points = seen_from({});
  ASSERT_GT(points.size(), 80U);
  EXPECT_LT(points.size(), 180U);
  std::size_t directed = 0;
  for (const SurfacePoint& point : points) {
    if (point.normal.isZero()) continue;
    ++directed;
    EXPECT_NEAR(point.normal.norm(), 1.0F, 1e-5F);
    EXPECT_LT(point.normal.dot(point.position), 0.0F);
  }
  EXPECT_GT(directed, points.size() * 8 / 10);
}

TEST(PointMap, FindsAPoseInAWindow) {
  PointMap map = map_from_origin();
  const Pose2 truth{0.42, -0.31, 0.25};
  const std::vector<SurfacePoint> scan = seen_from(truth);
  const auto found = map.search(scan, {{}, 0.8, 0.5}, 3);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front().pose.x, truth.x, 0.11);
  EXPECT_NEAR(found.front().pose.y, truth.y, 0.11);
  EXPECT_NEAR(found.front().pose.theta, truth.theta, 0.05);
  const PoseEstimate prior{found.front().pose, 0.04 * Eigen::Matrix3d::Identity()};
  const Registration refined = map.refine(scan, found.front().pose, prior);
  EXPECT_NEAR(refined.estimate.pose.x, truth.x, 0.005);
  EXPECT_NEAR(refined.estimate.pose.y, truth.y, 0.005);
  EXPECT_NEAR(refined.estimate.pose.theta, truth.theta, 0.003);
  EXPECT_GT(refined.share, 0.95);
  EXPECT_LT(map.share(scan, {1.5, -1.0, 1.0}), 0.3);
}

TEST(PointMap, FindsAllPlacesThatLookAlikeInALargeWindow) {
  PointMap map;
  map.clear({4.0, 0.0}, 12.0);
  map.add({}, seen_from({}));
  map.add({8.0, 1.0, 2.0}, seen_from({}));
  const Pose2 truth{0.42, -0.31, 0.25};
  const auto found = map.search(seen_from(truth), {{4.0, 0.0, 0.0}, 9.0, pi}, 20);
  ASSERT_GE(found.size(), 2U);
  const Pose2 other = compose({8.0, 1.0, 2.0}, truth);
  for (const Pose2& place : {truth, other}) {
    const bool is_found = std::any_of(found.begin(), found.begin() + 2, [&](const auto& candidate) {
      const Pose2 apart = between(place, candidate.pose);
      return std::hypot(apart.x, apart.y) < 0.15 && std::abs(apart.theta) < 0.05;
    });
    EXPECT_TRUE(is_found) << place.x << " " << place.y;
  }
}

TEST(PointMap, LeavesTheDirectionOfAWallOpen) {
  PointMap map;
  map.clear({0.0, 0.0}, 12.0);
  std::vector<Eigen::Vector2d> wall;
  for (int i = -300; i <= 300; ++i) wall.emplace_back(0.03 * i, 1.0);
  std::vector<SurfacePoint> surface;
  surface_points(wall, 0.05, 20.0, surface);
  map.add({}, surface);
  std::vector<SurfacePoint> part(surface.begin() + 80, surface.begin() + 160);
  const PoseEstimate prior{{0.3, 0.0, 0.0}, 0.04 * Eigen::Matrix3d::Identity()};
  const Registration refined = map.refine(part, {0.3, 0.05, 0.0}, prior);
  EXPECT_NEAR(refined.estimate.pose.x, 0.3, 0.02);  // by the prior
  EXPECT_NEAR(refined.estimate.pose.y, 0.0, 0.005);
  EXPECT_GT(refined.estimate.covariance(0, 0), 1.0);
  EXPECT_LT(refined.estimate.covariance(1, 1), 0.02 * 0.02);
}

TEST(PointMap, IsTheSameFromItsState) {
  PointMap map = map_from_origin();
  PointMap restored;
  restore_state(save_state(map), restored);
  const Pose2 pose{0.1, 0.1, 0.1};
  EXPECT_EQ(restored.share(seen_from(pose), pose), map.share(seen_from(pose), pose));
  EXPECT_EQ(save_state(restored), save_state(map));
}

}  // namespace
}  // namespace quoin
