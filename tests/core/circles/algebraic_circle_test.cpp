// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/circles/circle.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

constexpr std::array constraints{CircleConstraint::taubin, CircleConstraint::pratt,
                                 CircleConstraint::hyper};

Points arc(const Circle& circle, double from, double to, int count, double noise) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < count; ++i) {
    const double angle = from + (to - from) * i / (count - 1);
    const double x = circle.center.x() + circle.radius * std::cos(angle) + normal(engine);
    const double y = circle.center.y() + circle.radius * std::sin(angle) + normal(engine);
    bearings.push_back(std::atan2(y, x));
    ranges.push_back(std::hypot(x, y));
  }
  return points_from(bearings, ranges);
}

/// The same by a general eigenvalue solver in the coordinates of the scan.
Circle by_eigenvalues(const PointsView& points, CircleConstraint constraint) {
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d taubin = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x[i];
    const double y = points.y[i];
    const Eigen::Vector4d row(x * x + y * y, x, y, 1.0);
    const Eigen::Vector4d by_x(2.0 * x, 1.0, 0.0, 0.0);
    const Eigen::Vector4d by_y(2.0 * y, 0.0, 1.0, 0.0);
    moments += row * row.transpose();
    taubin += by_x * by_x.transpose() + by_y * by_y.transpose();
  }
  const auto count = static_cast<double>(points.size());
  Eigen::Matrix4d pratt = Eigen::Matrix4d::Zero();
  pratt(1, 1) = pratt(2, 2) = 1.0;
  pratt(0, 3) = pratt(3, 0) = -2.0;
  const Eigen::Matrix4d by =
      constraint == CircleConstraint::taubin  ? Eigen::Matrix4d(taubin / count)
      : constraint == CircleConstraint::pratt ? pratt
                                              : Eigen::Matrix4d(2.0 * taubin / count - pratt);
  // by v = (1 / eigenvalue) moments v: the moments can be inverted, the constraint of Taubin not.
  const Eigen::EigenSolver<Eigen::Matrix4d> solver((moments / count).inverse() * by);
  double largest = -std::numeric_limits<double>::infinity();
  Circle circle;
  for (int k = 0; k < 4; ++k) {
    if (solver.eigenvalues()(k).real() <= largest) continue;
    largest = solver.eigenvalues()(k).real();
    const Eigen::Vector4d v = solver.eigenvectors().col(k).real();
    circle.center = {-0.5 * v(1) / v(0), -0.5 * v(2) / v(0)};
    circle.radius = std::sqrt(circle.center.squaredNorm() - v(3) / v(0));
  }
  return circle;
}

TEST(AlgebraicCircle, IsExactWithoutNoise) {
  for (const CircleConstraint constraint : constraints) {
    for (const Circle& truth : {Circle{{3.0, -1.0}, 0.2}, Circle{{-30.0, 40.0}, 20.0}}) {
      const auto found = fit_algebraic_circle(arc(truth, 1.0, 2.0, 30, 0.0), constraint);
      ASSERT_TRUE(found);
      EXPECT_NEAR((found->center - truth.center).norm(), 0.0, 1e-7);
      EXPECT_NEAR(found->radius, truth.radius, 1e-7);
    }
  }
}

TEST(AlgebraicCircle, IsTheGeneralisedEigenvector) {
  const Points points = arc({{2.0, 1.0}, 0.5}, -2.0, 1.0, 25, 0.02);
  std::vector<double> radii;
  for (const CircleConstraint constraint : constraints) {
    const auto found = fit_algebraic_circle(points, constraint);
    const Circle expected = by_eigenvalues(points, constraint);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->center.x(), expected.center.x(), 1e-9);
    EXPECT_NEAR(found->center.y(), expected.center.y(), 1e-9);
    EXPECT_NEAR(found->radius, expected.radius, 1e-9);
    radii.push_back(found->radius);
  }
  EXPECT_GT(radii[1], radii[0]) << "Pratt's is the larger";
  EXPECT_LT(radii[2], radii[0]);
}

TEST(AlgebraicCircle, TwoPointsAndEqualPointsHaveNone) {
  EXPECT_FALSE(
      fit_algebraic_circle(arc({{2.0, 1.0}, 0.5}, 0.0, 1.0, 2, 0.0), CircleConstraint::taubin));
  EXPECT_FALSE(
      fit_algebraic_circle(arc({{2.0, 1.0}, 0.5}, 1.0, 1.0, 5, 0.0), CircleConstraint::taubin));
}

}  // namespace
}  // namespace quoin
