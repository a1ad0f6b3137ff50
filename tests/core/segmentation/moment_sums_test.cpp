// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/moment_sums.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

TEST(OrthogonalFit, HasThePrincipalAxesOfThePoints) {
  std::mt19937_64 engine(4);
  for (int k = 0; k < 60; ++k) {
    const Points points =
        wall_points({0.1 * k, 1.7}, 0.1 * k - 0.6, 0.1 * k + 0.2, 40, {0.03, 0.01, 0.0}, engine);
    PrefixMoments prefix;
    prefix.assign(points);
    const auto fit = orthogonal_fit(prefix(5, 35));
    ASSERT_TRUE(fit);
    Eigen::Matrix2Xd q(2, 30);
    for (int i = 0; i < 30; ++i) {
      q.col(i) << points.x[static_cast<std::size_t>(i + 5)],
          points.y[static_cast<std::size_t>(i + 5)];
    }
    const Eigen::Vector2d mean = q.rowwise().mean();
    q.colwise() -= mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(q * q.transpose() / 30.0);
    EXPECT_NEAR(fit->across, solver.eigenvalues()[0], 1e-12);
    EXPECT_NEAR(fit->along, solver.eigenvalues()[1], 1e-12);
    EXPECT_NEAR(fit->x, mean.x(), 1e-12);
    EXPECT_NEAR(fit->y, mean.y(), 1e-12);
    const Eigen::Vector2d normal(fit->line.normal_x, fit->line.normal_y);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(normal.dot(solver.eigenvectors().col(0))), 1.0, 1e-12);
    EXPECT_NEAR(normal.dot(mean), fit->line.offset, 1e-12);
  }
}

TEST(OrthogonalFit, HasNoLineWithoutADirection) {
  MomentSums moments;
  EXPECT_FALSE(orthogonal_fit(moments));
  moments.add(3.0, 4.0);
  EXPECT_FALSE(orthogonal_fit(moments));
  moments.add(3.0, 4.0);
  EXPECT_FALSE(orthogonal_fit(moments));
  MomentSums square;
  for (const double x : {1.0, 2.0}) {
    for (const double y : {1.0, 2.0}) square.add(x, y);
  }
  EXPECT_FALSE(orthogonal_fit(square));
  square.add(1.5, 7.0, 0.5);
  EXPECT_TRUE(orthogonal_fit(square));
}

TEST(JointFit, HasAChiSquareDistanceForOneWall) {
  // Faced squarely, so that a tolerance is 4 standard deviations of the range for all points.
  SegmentationParameters parameters;
  parameters.split_distance = 0.001;
  const SensorModel sensor{0.02, 0.0, 0.0};
  std::mt19937_64 engine(6);
  const int trials = 2000;
  double sum = 0.0;
  for (int k = 0; k < trials; ++k) {
    const Points points = wall_points({0.0, 20.0}, -0.05, 0.05, 40, sensor, engine);
    PrefixMoments moments;
    moments.assign(points);
    const auto joint = joint_fit(moments(0, 20), moments(20, 40), {parameters, sensor, points});
    ASSERT_TRUE(joint);
    sum += joint->distance;
  }
  // Two degrees of freedom: mean 2, variance 4. Four standard deviations of the mean.
  EXPECT_NEAR(sum / trials, 2.0, 4.0 * std::sqrt(4.0 / trials));
}

TEST(JointFit, IsFarForTwoWalls) {
  const Points points = exact_wall_points({0.0, 2.0}, -0.3, 0.3, 40);
  const Points other = exact_wall_points({1.2, 2.0}, 0.3, 0.9, 40);
  PrefixMoments first;
  PrefixMoments second;
  first.assign(points);
  second.assign(other);
  const Tolerance tolerance({}, {}, points);
  const auto joint = joint_fit(first(0, 40), second(0, 40), tolerance);
  ASSERT_TRUE(joint);
  EXPECT_GT(joint->distance, 100.0);
  EXPECT_FALSE(joint_fit(MomentSums{}, MomentSums{}, tolerance));
}

}  // namespace
}  // namespace quoin
