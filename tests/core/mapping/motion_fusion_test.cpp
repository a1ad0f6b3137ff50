// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/motion_fusion.hpp"

#include <gtest/gtest.h>

namespace quoin {
namespace {

PoseEstimate estimate(double x, double variance) {
  return {{x, 0.0, 0.0}, variance * Eigen::Matrix3d::Identity()};
}

TEST(Fuse, WeightsByCovariance) {
  PoseEstimate odometry = estimate(1.0, 4e-4);
  const PoseEstimate fused = fuse(odometry, estimate(1.02, 1e-4));
  EXPECT_NEAR(fused.pose.x, 1.0 + 0.8 * 0.02, 1e-12);
  EXPECT_NEAR(fused.covariance(0, 0), 0.8e-4, 1e-12);
  EXPECT_EQ(odometry.covariance(0, 0), 4e-4);
}

TEST(Fuse, WeakensOdometryThatThePointsRefute) {
  PoseEstimate odometry = estimate(1.0, 1e-4);
  const PoseEstimate fused = fuse(odometry, estimate(1.3, 1e-4));
  const double squared = 0.3 * 0.3 / 2e-4;
  EXPECT_NEAR(odometry.covariance(0, 0), 1e-4 * squared / 3.0, 1e-9);
  EXPECT_GT(fused.pose.x, 1.29);
}

TEST(ComposeCorrelated, HoldsForErrorsThatAreTheSame) {
  PoseEstimate sum = estimate(0.0, 0.0);
  for (int i = 0; i < 10; ++i) sum = compose_correlated(sum, estimate(0.1, 1e-4));
  // The same error ten times: ten times the standard deviation.
  EXPECT_NEAR(sum.pose.x, 1.0, 1e-12);
  EXPECT_GE(sum.covariance(0, 0), 100.0 * 1e-4 * 0.999);
}

TEST(OdometryScale, GrowsToWhatRegistrationsShow) {
  OdometryScale scale;
  const Eigen::Matrix3d noise = 1e-8 * Eigen::Matrix3d::Identity();
  const PoseEstimate step = estimate(0.1, 1e-4);
  EXPECT_EQ(scale.scaled(step).covariance, step.covariance);
  // Errors of 0.03 m in x alone: squared, 4.5 times what the covariance says of x and y.
  for (int i = 0; i < 400; ++i) scale.judge(step, {0.13, 0.0, 0.0}, noise);
  EXPECT_NEAR(scale.scaled(step).covariance(0, 0), 4.5e-4, 0.01e-4);
  EXPECT_EQ(scale.scaled(step).covariance(2, 2), 1e-4);
  for (int i = 0; i < 400; ++i) scale.judge(step, step.pose, noise);
  EXPECT_EQ(scale.scaled(step).covariance(0, 0), 1e-4);
}

}  // namespace
}  // namespace quoin
