// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/orthogonal.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

TEST(OrthogonalLine, HasThePrincipalAxesOfThePoints) {
  std::mt19937_64 engine(4);
  for (int k = 0; k < 60; ++k) {
    const Points points =
        wall_points({0.1 * k, 1.7}, 0.1 * k - 0.6, 0.1 * k + 0.2, 40, {0.03, 0.01, 0.0}, engine);
    Moments moments;
    for (std::size_t i = 5; i < 35; ++i) moments.add(points.x[i], points.y[i]);
    const OrthogonalLine fit = orthogonal_line(moments);
    ASSERT_TRUE(fit.ok());
    Eigen::Matrix2Xd q(2, 30);
    for (int i = 0; i < 30; ++i) {
      q.col(i) << points.x[static_cast<std::size_t>(i + 5)],
          points.y[static_cast<std::size_t>(i + 5)];
    }
    const Eigen::Vector2d mean = q.rowwise().mean();
    q.colwise() -= mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(q * q.transpose() / 30.0);
    EXPECT_NEAR(fit.across / 30.0, solver.eigenvalues()[0], 1e-12);
    EXPECT_NEAR(fit.along / 30.0, solver.eigenvalues()[1], 1e-12);
    EXPECT_NEAR(fit.moments.mean_x, mean.x(), 1e-12);
    EXPECT_NEAR(fit.moments.mean_y, mean.y(), 1e-12);
    const Eigen::Vector2d normal(fit.line.normal_x, fit.line.normal_y);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(normal.dot(solver.eigenvectors().col(0))), 1.0, 1e-12);
    EXPECT_NEAR(normal.dot(mean), fit.line.offset, 1e-12);
  }
}

TEST(OrthogonalLine, HasNoLineWithoutADirection) {
  Moments moments;
  EXPECT_FALSE(orthogonal_line(moments).ok());
  moments.add(3.0, 4.0);
  EXPECT_FALSE(orthogonal_line(moments).ok());
  moments.add(3.0, 4.0);
  EXPECT_FALSE(orthogonal_line(moments).ok());
  Moments square;
  for (const double x : {1.0, 2.0}) {
    for (const double y : {1.0, 2.0}) square.add(x, y);
  }
  EXPECT_FALSE(orthogonal_line(square).ok());
  square.add(1.5, 7.0, 0.5);
  EXPECT_TRUE(orthogonal_line(square).ok());
}

}  // namespace
}  // namespace quoin
