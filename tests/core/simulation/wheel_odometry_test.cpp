// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/wheel_odometry.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace quoin {
namespace {

OdometryNoise none() { return {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}; }

TEST(WheelOdometry, WithoutErrorsIsTheWay) {
  WheelOdometry wheels({0.0, 0.0, none()}, 1);
  const Pose2 start{3.0, -1.0, 0.7};
  const Pose2 end{4.0, 2.0, -2.0};
  wheels.move_to(start);
  wheels.move_to({3.5, 1.0, 1.5});
  wheels.move_to(end);
  const Pose2 way = between(start, end);
  EXPECT_NEAR(wheels.estimate().pose.x, way.x, 1e-12);
  EXPECT_NEAR(wheels.estimate().pose.y, way.y, 1e-12);
  EXPECT_NEAR(wheels.estimate().pose.theta, way.theta, 1e-12);
  EXPECT_TRUE(wheels.estimate().covariance.isZero());
}

TEST(WheelOdometry, CountsSlipAndBias) {
  WheelOdometry wheels({0.02, 0.01, none()}, 1);
  for (int i = 0; i <= 100; ++i) wheels.move_to({0.1 * i, 0.0, 0.0});
  EXPECT_NEAR(wheels.estimate().pose.theta, 0.1, 1e-9);
  EXPECT_NEAR(wheels.estimate().pose.x, 10.2 * std::sin(0.1) / 0.1, 1e-3);
  EXPECT_GT(wheels.estimate().covariance(2, 2), 0.0);
}

TEST(WheelOdometry, HasTheCovarianceOfItsNoise) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  constexpr int runs = 3000;
  Eigen::Matrix3d expected;
  const auto drive = [](WheelOdometry& wheels) {
    for (int i = 0; i <= 20; ++i) wheels.move_to({0.1 * i, 0.0, 0.02 * i});
  };
  for (int run = 0; run < runs; ++run) {
    WheelOdometry exact({0.0, 0.0, none()}, 1);
    WheelOdometry wheels({}, static_cast<std::uint64_t>(run));
    drive(exact);
    drive(wheels);
    const Pose2& pose = wheels.estimate().pose;
    const Pose2& truth = exact.estimate().pose;
    const Eigen::Vector3d error(pose.x - truth.x, pose.y - truth.y, pose.theta - truth.theta);
    sum += error * error.transpose();
    expected = wheels.estimate().covariance;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(sum(i, i) / runs / expected(i, i), 1.0, 0.1) << "3 standard deviations: 0.08";
  }
}

TEST(WheelOdometry, SameSeedSameOdometry) {
  WheelOdometry first({}, 7), same({}, 7), other({}, 8);
  for (WheelOdometry* wheels : {&first, &same, &other}) {
    wheels->move_to({});
    wheels->move_to({1.0, 0.0, 0.0});
  }
  EXPECT_EQ(first.estimate().pose.x, same.estimate().pose.x);
  EXPECT_NE(first.estimate().pose.x, other.estimate().pose.x);
}

}  // namespace
}  // namespace quoin
