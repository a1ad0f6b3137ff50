// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/fit_timing.hpp"

#include <gmock/gmock.h>

#include "core/fitting/algebraic.hpp"

namespace quoin {
namespace {

TEST(FitTiming, WallsHaveThePointsAskedForAndALineEach) {
  const std::vector<Points> walls = timing_walls(100);
  ASSERT_GT(walls.size(), 1U);
  for (const Points& wall : walls) {
    ASSERT_EQ(wall.size(), 100U);
    const FitResult fit = Wctls{}(wall, SensorModel{});
    ASSERT_TRUE(fit.ok());
    // Walls at 2 m; the noise of the mean of 100 ranges is a hundredth of this.
    EXPECT_NEAR(fit.estimate.line.r, 2.0, 0.1);
  }
  EXPECT_NE(walls[0].range, walls[1].range);
  EXPECT_EQ(timing_walls(100)[0].range, walls[0].range);
}

TEST(FitTiming, PlainCovarianceIsThatOfTheSample) {
  // x: -1, 0, 1 and y: 1, 0, 2 about a mean far away.
  Points points;
  points.resize(3);
  points.x = {99.0, 100.0, 101.0};
  points.y = {-49.0, -50.0, -48.0};
  const Eigen::Matrix2d covariance = plain_covariance(points);
  EXPECT_DOUBLE_EQ(covariance(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(covariance(1, 1), 1.0);
  EXPECT_DOUBLE_EQ(covariance(0, 1), 0.5);
  EXPECT_DOUBLE_EQ(covariance(1, 0), 0.5);
}

TEST(FitTiming, EveryWallIsFittedEquallyOften) {
  const std::vector<Points> walls = timing_walls(5);
  std::vector<long> calls(walls.size(), 0);
  const Fitter counting = [&](const PointsView& points, const SensorModel&) {
    for (std::size_t k = 0; k < walls.size(); ++k) {
      if (points.range.data() == walls[k].range.data()) ++calls[k];
    }
    return FitResult{};
  };
  EXPECT_GT(seconds_per_fit(counting, walls), 0.0);
  EXPECT_GT(seconds_per_plain_covariance(walls), 0.0);
  EXPECT_GT(calls.front(), 0);
  EXPECT_THAT(calls, testing::Each(calls.front()));
}

}  // namespace
}  // namespace quoin
