// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/circle.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

/// The near side of a column, `count` rays from edge to edge.
Points column(const Circle& circle, int count, double noise, std::mt19937_64& engine) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const double distance = circle.center.norm();
  const double direction = std::atan2(circle.center.y(), circle.center.x());
  const double half = 0.95 * std::asin(circle.radius / distance);
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < count; ++i) {
    const double angle = half * (2.0 * i / (count - 1) - 1.0);
    const double across = distance * std::sin(angle);
    bearings.push_back(direction + angle);
    ranges.push_back(distance * std::cos(angle) -
                     std::sqrt(circle.radius * circle.radius - across * across) +
                     noise * normal(engine));
  }
  return points_from(bearings, ranges);
}

TEST(FitCircle, IsExactWithoutNoise) {
  std::mt19937_64 engine(1);
  for (const Circle& truth : {Circle{{2.0, 1.0}, 0.3}, Circle{{-5.0, 0.1}, 2.0}}) {
    const auto found = fit_circle(column(truth, 40, 0.0, engine), SensorModel{});
    ASSERT_TRUE(found);
    EXPECT_NEAR((found->center - truth.center).norm(), 0.0, 1e-9);
    EXPECT_NEAR(found->radius, truth.radius, 1e-9);
  }
}

TEST(FitCircle, LeavesTheResidualsThatNoiseMakes) {
  std::mt19937_64 engine(2);
  const SensorModel sensor{0.01, 0.0, 0.0};
  double sum = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const Points points = column({{2.0, 1.0}, 0.5}, 50, 0.01, engine);
    const auto found = fit_circle(points, sensor);
    ASSERT_TRUE(found);
    sum += chi_square(*found, points, sensor);
  }
  EXPECT_NEAR(sum / 200 / 47, 1.0, 0.05);  // 5 standard deviations
}

TEST(FitCircle, FindsNoneOnALine) {
  EXPECT_FALSE(fit_circle(exact_wall_points({0.0, 2.0}, -0.1, 0.1, 2), SensorModel{}));
  const auto found = fit_circle(exact_wall_points({0.0, 2.0}, -0.3, 0.3, 50), SensorModel{});
  EXPECT_TRUE(!found || found->radius > 1e3);
}

TEST(CoveredAngle, IsThatAboutTheCentre) {
  std::mt19937_64 engine(1);
  const Circle circle{{2.0, 0.0}, 1.0};
  const Points points = exact_wall_points({0.0, 1.0}, -0.5, 0.5, 3);
  EXPECT_NEAR(covered_angle(circle, points), 2.0 * std::atan(std::tan(0.5)), 1e-9);
}

}  // namespace
}  // namespace quoin
