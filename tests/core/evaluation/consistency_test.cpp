// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/consistency.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/fitting/fitters.hpp"
#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

Scene scene_of(const char* name, std::size_t rays) {
  const World world = built_in_world(name).value();
  return observe(world, world.path.front(), rays);
}

TEST(Scene, ShowsTheWallsAndCornersOfTheSquareRoom) {
  const Scene scene = scene_of("square_room", 920);
  ASSERT_EQ(scene.walls.size(), 4U);
  ASSERT_EQ(scene.corners.size(), 4U);
  std::size_t rays = 0;
  for (const VisibleWall& wall : scene.walls) {
    EXPECT_NEAR(wall.line.r, 2.0, 1e-12);
    rays += wall.bearings.size();
    for (std::size_t i = 0; i < wall.bearings.size(); ++i) {
      EXPECT_NEAR(wall.ranges[i] * std::cos(wall.bearings[i] - wall.line.alpha), 2.0, 1e-12);
    }
  }
  EXPECT_EQ(rays, 920U);
  for (const VisibleCorner& corner : scene.corners) {
    EXPECT_NEAR(corner.position.norm(), std::sqrt(8.0), 1e-12);
    EXPECT_EQ(corner.second, (corner.first + 1) % 4);
  }
}

// The counts of the WCTLS paper's section 4.
TEST(Scene, ShowsTheCornersOfThePapersEnvironments) {
  EXPECT_EQ(scene_of("environment_a", 935).corners.size(), 18U);
  EXPECT_EQ(scene_of("environment_b", 887).corners.size(), 23U);
}

TEST(CramerRao, IsTheCovarianceOfTheMeanForOneDistance) {
  // Rays almost parallel to the normal: r is known like the mean of the ranges.
  Points points;
  points.resize(2);
  points.range = {1.0, 1.0};
  points.bearing = {-1e-3, 1e-3};
  points.cosine = {1.0, 1.0};
  points.sine = {-1e-3, 1e-3};
  const Eigen::Matrix2d bound = cramer_rao_bound({0.0, 1.0}, points, {0.01, 0.0, 0.0});
  EXPECT_NEAR(bound(1, 1), 0.01 * 0.01 / 2.0, 1e-9);
  EXPECT_NEAR(bound(0, 0), 0.01 * 0.01 / (2.0 * 1e-6), 1e-6);
  EXPECT_NEAR(bound(0, 1), 0.0, 1e-12);
}

TEST(Consistency, IsTrueOfPropagatedCovariancesAndRepeatsItself) {
  const Scene scene = scene_of("environment_a", 935);
  const Fitter fitter = Fitters::make<Fitter>("wctls", {});
  const SensorModel noise;
  const Consistency first = judge_consistency(fitter, scene, noise, 400, 5);
  const Consistency again = judge_consistency(fitter, scene, noise, 400, 5);
  EXPECT_EQ(first.nees.value, again.nees.value);
  EXPECT_EQ(first.rmse_over_crb, again.rmse_over_crb);
  // 7200 corners, neighbours correlated.
  EXPECT_NEAR(first.nees.value, 2.0, 0.15);
  EXPECT_NEAR(first.coverage95.value, 0.95, 0.012);
  EXPECT_LT(first.coverage95.low, first.coverage95.value);
  EXPECT_GT(first.rmse_over_crb, 0.95);
  EXPECT_LT(first.rmse_over_crb, 1.1);
  EXPECT_LT(first.rmse_over_crb_interval.low, first.rmse_over_crb);
  EXPECT_GT(first.rmse_over_crb_interval.high, first.rmse_over_crb);
  // Relative error of a root mean square of n Gaussian pairs: 1 / (2 sqrt(n)), 400 trials.
  EXPECT_LT(first.rmse_over_crb_interval.high - first.rmse_over_crb_interval.low, 4.0 * 0.025);
  EXPECT_LT(first.worst_corner, 5.0);
  EXPECT_EQ(first.corners.size(), 18U);
}

TEST(Consistency, SeesCovariancesThatAreTooSmall) {
  const Scene scene = scene_of("square_room", 920);
  const Fitter fitter = Fitters::make<Fitter>("wctls", {});
  const Fitter boastful = [&fitter](const PointsView& points, const SensorModel& sensor) {
    FitResult result = fitter(points, sensor);
    result.estimate.covariance *= 0.25;
    return result;
  };
  const Consistency consistency = judge_consistency(boastful, scene, {}, 400, 5);
  // Four times the squared distance; P(chi^2_2 < 5.99 / 4) = 1 - exp(-0.749) = 0.527.
  EXPECT_NEAR(consistency.nees.value, 8.0, 0.8);
  EXPECT_NEAR(consistency.coverage95.value, 0.527, 0.04);
  EXPECT_GT(consistency.worst_corner, 10.0);
}

TEST(Consistency, CountsFailuresByName) {
  const Scene scene = scene_of("square_room", 920);
  const Fitter fails = [](const PointsView&, const SensorModel&) {
    return FitResult::failed(FitFailure::degenerate);
  };
  const Consistency consistency = judge_consistency(fails, scene, {}, 10, 5);
  EXPECT_EQ(consistency.failures[static_cast<std::size_t>(FitFailure::degenerate)], 40U);
  EXPECT_EQ(consistency.failures[static_cast<std::size_t>(FitFailure::none)], 0U);
  EXPECT_TRUE(consistency.corners.empty());
  EXPECT_EQ(consistency.rmse_over_crb, 0.0);
}

}  // namespace
}  // namespace quoin
