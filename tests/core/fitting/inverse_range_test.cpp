// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <Eigen/LU>

#include "core/fitting/likelihood_fitters.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/fitting/near_wall.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

TEST(InverseRange, IsMaximumLikelihoodButForSecondOrder) {
  std::mt19937_64 engine(21);
  const Fitter closed = make_fitter("inverse_range");
  const Fitter iterated = make_fitter("maximum_likelihood");
  for (int k = 0; k < 200; ++k) {
    const Points p = wall_points({0.4, 1.7}, -0.2, 0.9, 80, noisy, engine);
    const LineEstimate a = closed(p, noisy).estimate;
    const LineEstimate b = iterated(p, noisy).estimate;
    const Eigen::Vector2d difference(a.line.alpha - b.line.alpha, a.line.r - b.line.r);
    // The noise is 3 % of the range, so that second orders are some per cent of the first.
    EXPECT_LT(std::sqrt(difference.dot(b.covariance.inverse() * difference)), 0.2);
    EXPECT_THAT(a.covariance, CovarianceNear(b.covariance, 0.05));
  }
}

TEST(InverseRange, HasNotTheBiasOfTheMeanInverse) {
  // Rays nearly across the wall: the mean of 1 / range exceeds 1 / r by the share sr^2 / r^2.
  // Looked at on the middle ray, where the errors of alpha and r do not matter together.
  std::mt19937_64 engine(22);
  const Line truth{0.4, 1.2};
  const SensorModel sensor{0.05, 0.0, 0.0};
  const int trials = 4000;
  const auto error = [&](const LineEstimate& e) {
    return e.line.r / std::cos(e.line.alpha - truth.alpha) - truth.r;
  };
  double weighted = 0.0;
  double plain = 0.0;
  for (int k = 0; k < trials; ++k) {
    const Points p = wall_points(truth, 0.2, 0.6, 60, sensor, engine);
    weighted += error(make_fitter("inverse_range")(p, sensor).estimate) / trials;
    plain += error(make_fitter("wtls")(p, sensor).estimate) / trials;
  }
  const double error_of_mean = sensor.range_stddev / std::sqrt(60.0 * trials);
  const double bias = -sensor.range_stddev * sensor.range_stddev / truth.r;
  EXPECT_LT(bias, -10.0 * error_of_mean);
  EXPECT_NEAR(plain, bias, 4.0 * error_of_mean);
  EXPECT_NEAR(weighted, 0.0, 4.0 * error_of_mean);
}

TEST(InverseRange, IsRightNearTheSensorOrSaysNothing) {
  for (const SensorModel& sensor : {SensorModel{0.01, 0.00197, 0.0}, noisy}) {
    EXPECT_LT(near_wall("inverse_range", 0.0, sensor).found, 0.35);
    for (const double r : {0.01, 0.03, 0.1, 0.3, 1.0}) {
      const NearWall wall = near_wall("inverse_range", r, sensor);
      // 2000 trials: standard deviation 0.05; second orders add as much at the larger noise.
      if (wall.found > 0.5) {
        EXPECT_NEAR(wall.nees, 2.0, 0.25) << r;
      }
    }
    EXPECT_GT(near_wall("inverse_range", 0.1, sensor).found, 0.99);
    EXPECT_EQ(near_wall("inverse_range", 1.0, sensor).found, 1.0);
  }
}

}  // namespace
}  // namespace quoin
