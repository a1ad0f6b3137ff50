// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/angular_offsets.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

using Point = Eigen::Vector2d;

/// What a sensor at `pose` sees of segments, without noise.
std::vector<LineSegment> seen_from(const Pose2& pose,
                                   const std::vector<std::pair<Point, Point>>& walls) {
  std::vector<LineSegment> lines;
  for (const auto& [start, end] : walls) {
    LineSegment line;
    line.start = pose.inverse_transform(start);
    line.end = pose.inverse_transform(end);
    const Point along = (line.end - line.start).normalized();
    const Point normal(along.y(), -along.x());
    line.estimate.line = NormalLine{normal.x(), normal.y(), normal.dot(line.start)}.normal_form();
    line.estimate.covariance = Eigen::Vector2d(1e-6, 1e-5).asDiagonal();
    line.points = 50;
    lines.push_back(line);
  }
  return lines;
}

const std::vector<std::pair<Point, Point>> room{
    {{-2, -1}, {3, -1}}, {{3, -1}, {3, 2}}, {{3, 2}, {-2, 2}}, {{-2, 2}, {-2, -1}}};

TEST(AngularOffsets, TakeTheHeadingFromTheWalls) {
  AngularOffsets localizer;
  Localization result;
  localizer({0.0, seen_from({0, 0, 0}, room), {}, {}, true}, result);
  EXPECT_EQ(result.map.size(), 4U);
  EXPECT_EQ(result.matched, 0U);
  // Odometry says 0.1 rad less than the robot turned.
  const Pose2 truth{0.2, 0.0, 0.3};
  localizer({0.1,
             seen_from(truth, room),
             {},
             PoseEstimate{{0.2, 0.0, 0.2}, 1e-4 * Eigen::Matrix3d::Identity()},
             true},
            result);
  EXPECT_EQ(result.matched, 4U);
  EXPECT_EQ(result.map.size(), 4U);
  EXPECT_NEAR(result.pose.pose.theta, 0.3, 1e-9);
  EXPECT_EQ(result.status, LocalizationStatus::tracking);
  // Eq. 14: driven again from the previous position, with the heading turned by the correction.
  EXPECT_NEAR(result.pose.pose.x, 0.2 * std::cos(0.1), 1e-9);
  EXPECT_NEAR(result.pose.pose.y, 0.2 * std::sin(0.1), 1e-9);
}

TEST(AngularOffsets, WeighNearMatchesMore) {
  AngularOffsets localizer;
  Localization result;
  localizer({0.0, seen_from({0, 0, 0}, {{{-1, 2}, {1, 2}}, {{-1, -2}, {1, -2}}}), {}, {}, false},
            result);
  // One wall where it was, but turned by 0.06; the other 0.4 m off, not turned.
  const double turn = 0.06;
  const Point half(std::cos(turn), std::sin(turn));
  const std::vector<std::pair<Point, Point>> moved{{Point(0, 2) - half, Point(0, 2) + half},
                                                   {{-1, -2.2}, {1, -2.2}}};
  localizer({0.1, seen_from({0, 0, 0}, moved), {}, PoseEstimate{}, false}, result);
  ASSERT_EQ(result.matched, 2U);
  // Distances: 0.4 for the second; the first has 2 (1 - cos 0.06) = 0.0036, counted as 0.01.
  const double near = 1.0 / 0.01;
  const double far = 1.0 / 0.4;
  EXPECT_NEAR(result.pose.pose.theta, -turn * near / (near + far), 1e-4);
}

TEST(AngularOffsets, GoOnAtConstantVelocityWithoutOdometry) {
  AngularOffsets localizer;
  Localization result;
  for (int i = 0; i < 6; ++i) {
    localizer({0.1 * i, seen_from({0, 0, 0.05 * i}, room), {}, {}, false}, result);
    EXPECT_NEAR(result.pose.pose.theta, 0.05 * i, 1e-9);
  }
}

TEST(AngularOffsets, SayWhenNoLineIsKnown) {
  AngularOffsets localizer;
  Localization result;
  localizer({0.0, seen_from({0, 0, 0}, room), {}, {}, false}, result);
  localizer({0.1, {}, {}, PoseEstimate{}, false}, result);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
}

}  // namespace
}  // namespace quoin
