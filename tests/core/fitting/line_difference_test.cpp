// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/line_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/fitting/likelihood_fitters.hpp"
#include "core/simulation/random.hpp"

namespace quoin {
namespace {

TEST(LineDifference, IsTheMahalanobisDistanceAtThePoint) {
  // At (2, 0) on the line x = 2, the foot of the perpendicular.
  const Eigen::Matrix2d covariance = Eigen::Vector2d(0.01 * 0.01, 0.02 * 0.02).asDiagonal();
  const LineEstimate first{{0.0, 2.0}, covariance};
  const LineEstimate second{{0.01, 2.0}, covariance};
  EXPECT_NEAR(LineDifference(first, second, {2.0, 0.0}).mahalanobis_squared(), 0.5, 1e-3);
  // At (2, 3) the second is off by 3 cm as well; both together say no more than the direction does.
  EXPECT_NEAR(LineDifference(first, second, {2.0, 3.0}).mahalanobis_squared(), 0.5, 2e-3);
  const LineEstimate shifted{{0.0, 2.04}, covariance};
  EXPECT_NEAR(LineDifference(first, shifted, {2.0, 0.0}).mahalanobis_squared(), 2.0, 1e-9);
}

TEST(LineDifference, HoldsWhereTheNormalTurnsOver) {
  Eigen::Matrix2d covariance;
  covariance << 1e-4, 5e-5, 5e-5, 1e-4;
  const LineEstimate first{{1.0, 0.002}, covariance};
  const LineEstimate second = normalized({{1.01, -0.003}, covariance});
  EXPECT_LT(second.line.alpha, -2.0);
  const LineEstimate same{{1.01, -0.003}, covariance};
  EXPECT_NEAR(LineDifference(first, second, {0.5, 0.5}).mahalanobis_squared(),
              LineDifference(first, same, {0.5, 0.5}).mahalanobis_squared(), 1e-9);
}

TEST(LineDifference, IsInfiniteWithoutACovariance) {
  const LineEstimate line{{0.0, 2.0}, Eigen::Matrix2d::Zero()};
  EXPECT_EQ(LineDifference(line, line, {2.0, 0.0}).mahalanobis_squared(),
            std::numeric_limits<double>::infinity());
}

TEST(OddEven, IsChiSquareOfTheNoiseOfSingleRays) {
  // A wall at 2 m that bulges by 5 cm: both lines share the bulge.
  const SensorModel sensor;
  Random random(7);
  Points points;
  Points scratch;
  double sum = 0.0;
  constexpr int trials = 2000;
  for (int trial = 0; trial < trials; ++trial) {
    points.resize(101);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double bearing = -0.5 + 0.01 * static_cast<double>(i);
      points.bearing[i] = bearing + sensor.bearing_stddev * random.normal();
      points.range[i] = 2.0 / std::cos(bearing) + 0.05 * std::cos(3.0 * bearing) +
                        sensor.range_stddev * random.normal();
    }
    compute_cartesian(points);
    const auto squared = odd_even_squared(InverseRange(), points, sensor, scratch);
    ASSERT_TRUE(squared);
    sum += *squared;
  }
  EXPECT_NEAR(sum / trials, 2.0, 0.2);  // four standard errors
}

TEST(OddEven, IsNothingWithoutALine) {
  Points points;
  points.resize(4);
  std::fill(points.range.begin(), points.range.end(), 1.0);
  compute_cartesian(points);
  Points scratch;
  EXPECT_FALSE(odd_even_squared(InverseRange(), points, {}, scratch));
}

TEST(TakeEveryOther, TakesTheEvenOrTheOddPoints) {
  Points points;
  points.resize(5);
  for (std::size_t i = 0; i < 5; ++i) {
    points.range[i] = 1.0 + static_cast<double>(i);
    points.bearing[i] = 0.1 * static_cast<double>(i);
  }
  compute_cartesian(points);
  Points taken;
  take_every_other(points, 0, taken);
  ASSERT_EQ(taken.size(), 3U);
  EXPECT_EQ(taken.range[2], 5.0);
  EXPECT_EQ(taken.x[2], points.x[4]);
  take_every_other(points, 1, taken);
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken.bearing[1], points.bearing[3]);
  EXPECT_EQ(taken.inverse_range[1], 0.25);
}

}  // namespace
}  // namespace quoin
