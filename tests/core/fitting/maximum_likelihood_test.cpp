// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/maximum_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/LU>

#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

/// Sum over the rays of derivative * residual / variance, in (alpha, r): zero at the estimate.
Eigen::Vector2d score(const Line& line, const PointsView& p, const SensorModel& sensor) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double phi = p.bearing[i] - line.alpha;
    const double range = line.r / std::cos(phi);
    const double slope = range * std::tan(phi);
    const double variance =
        std::pow(sensor.range_stddev, 2) + std::pow(slope * sensor.bearing_stddev, 2);
    sum += Eigen::Vector2d(-slope, 1.0 / std::cos(phi)) * ((p.range[i] - range) / variance);
  }
  return sum;
}

TEST(MaximumLikelihood, SolvesItsEquations) {
  for (const Points& p : {first_wall(), second_wall()}) {
    const FitResult fit = make_fitter("maximum_likelihood")(p, noisy);
    ASSERT_TRUE(fit.ok());
    const Eigen::Vector2d s = score(fit.estimate.line, p, noisy);
    // In standard deviations of the line; the iteration ends at 1e-7.
    EXPECT_LT(std::sqrt(s.dot(fit.estimate.covariance * s)), 1e-6);
    EXPECT_GE(fit.iterations, 2);
    EXPECT_LE(fit.iterations, 10);
  }
}

TEST(MaximumLikelihood, TakesOneIterationForExactPoints) {
  const FitResult fit =
      make_fitter("maximum_likelihood")(exact_wall_points({0.4, 1.7}, 0.0, 0.9, 30), noisy);
  EXPECT_EQ(fit.iterations, 1);
  EXPECT_TRUE(fit.converged);
}

TEST(MaximumLikelihood, FindsTheWallUnderExtremeNoise) {
  std::mt19937_64 engine(13);
  const Line truth{0.4, 1.7};
  const SensorModel sensor{0.4, 0.05, 0.0};
  const Fitter fitter = make_fitter("maximum_likelihood");
  const int trials = 2000;
  int found = 0;
  for (int k = 0; k < trials; ++k) {
    const Points p = wall_points(truth, -0.4, 0.9, 100, sensor, engine);
    if (*std::min_element(p.range.begin(), p.range.end()) < 0.05) continue;
    const FitResult fit = fitter(p, sensor);
    if (!fit.ok()) continue;
    const Eigen::Vector2d error(normalized_angle(fit.estimate.line.alpha - truth.alpha),
                                fit.estimate.line.r - truth.r);
    // A thousandth of all would lie beyond 13.8 if the propagation were linear.
    found += error.dot(fit.estimate.covariance.inverse() * error) < 20.0 ? 1 : 0;
  }
  EXPECT_GT(found, trials * 95 / 100);
}

}  // namespace
}  // namespace quoin
