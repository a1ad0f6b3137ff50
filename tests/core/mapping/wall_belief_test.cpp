// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/wall_belief.hpp"

#include <array>

#include <gtest/gtest.h>

namespace quoin {
namespace {

LineMeasurement wall_at(double alpha, double distance) {
  LineMeasurement m;
  m.alpha = alpha;
  m.middle = distance * Eigen::Vector2d(std::cos(alpha), std::sin(alpha));
  m.half_length = 1.0;
  m.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  return m;
}

/// Two walls at right angles, known far better than the pose.
struct Corner {
  std::array<LineLandmark, 2> map{landmark_of({}, wall_at(0.0, 2.0)),
                                  landmark_of({}, wall_at(1.5707963267948966, 3.0))};
  WallBelief belief;
  Corner() {
    belief.covariance = Eigen::Matrix3d(1e-4 * Eigen::Matrix3d::Identity());
    for (std::size_t k = 0; k < 2; ++k) {
      belief.landmarks.push_back(k);
      belief.walls.emplace_back(map[k].phi, map[k].offset);
    }
    Eigen::MatrixXd covariance = 1e-10 * Eigen::MatrixXd::Identity(7, 7);
    covariance.topLeftCorner<3, 3>() = belief.covariance;
    belief.covariance = covariance;
  }
};

TEST(WallBelief, UpdatesThePoseHalfWayForAMeasurementAsExact) {
  Corner corner;
  // The wall ahead is 2 cm nearer than believed.
  update_with(corner.belief, corner.map, 0, wall_at(0.0, 1.98));
  EXPECT_NEAR(corner.belief.pose.x, 0.01, 1e-4);
  EXPECT_NEAR(corner.belief.pose.y, 0.0, 1e-4);
  EXPECT_NEAR(corner.belief.covariance(0, 0), 0.5e-4, 1e-6);
  EXPECT_NEAR(corner.belief.covariance(1, 1), 1e-4, 1e-6);
}

TEST(WallBelief, DropsPairsThatThePosteriorDoesNotExplain) {
  Corner corner;
  corner.belief.covariance.topLeftCorner<3, 3>() *= 1e-4;  // a pose that no line draws away
  const std::array<LineMeasurement, 3> scan{wall_at(0.0, 2.0), wall_at(1.5707963267948966, 3.0),
                                            wall_at(0.0, 1.0)};
  WallPairs pairs{{0, 0}, {1, 1}, {2, 0}};
  WallBelief posterior;
  EXPECT_TRUE(update_with(corner.belief, corner.map, scan, pairs, posterior));
  EXPECT_EQ(pairs, (WallPairs{{0, 0}, {1, 1}}));
  EXPECT_NEAR(posterior.pose.x, 0.0, 1e-3);
}

TEST(WallBelief, GrowsByWallsThatShareTheErrorOfThePose) {
  Corner corner;
  const LineMeasurement m = wall_at(3.141592653589793, 1.0);
  append_wall(corner.belief, 2, landmark_of({}, m), m);
  ASSERT_EQ(corner.belief.covariance.rows(), 9);
  EXPECT_NEAR(corner.belief.covariance(8, 8), 2e-4, 1e-6);  // of the pose and of the line
  EXPECT_NEAR(std::abs(corner.belief.covariance(0, 8)), 1e-4, 1e-6);
}

TEST(WallBelief, ForgetsMergedWalls) {
  Corner corner;
  corner.map[0].alive = false;
  corner.belief.covariance(5, 5) = 7.0;
  corner.belief.forget_merged(corner.map);
  EXPECT_EQ(corner.belief.landmarks, std::vector<std::size_t>{1});
  ASSERT_EQ(corner.belief.covariance.rows(), 5);
  EXPECT_EQ(corner.belief.covariance(3, 3), 7.0);
}

TEST(Predict, AddsTheCovarianceOfTheMotionTurnedIntoTheMap) {
  Corner corner;
  corner.belief.pose.theta = 1.5707963267948966;
  const WallBelief after =
      predict(corner.belief, {{1.0, 0.0, 0.0}, Eigen::Vector3d(0.04, 0.01, 0.0).asDiagonal()});
  EXPECT_NEAR(after.pose.y, 1.0, 1e-12);
  EXPECT_NEAR(after.covariance(0, 0), 0.01 + 2e-4, 1e-9);  // a turn moves the end by 1 m per radian
  EXPECT_NEAR(after.covariance(1, 1), 0.04 + 1e-4, 1e-9);
}

}  // namespace
}  // namespace quoin
