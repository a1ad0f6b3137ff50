// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/LU>

#include "core/fitting/likelihood_fitters.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/fitting/near_wall.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

/// Half the sum of squared distances over their variances.
double objective(double alpha, double r, const PointsView& p, const SensorModel& sensor) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double phi = p.bearing[i] - alpha;
    const double distance = p.range[i] * std::cos(phi) - r;
    sum += 0.5 * distance * distance /
           (std::pow(sensor.range_stddev * std::cos(phi), 2) +
            std::pow(p.range[i] * sensor.bearing_stddev * std::sin(phi), 2));
  }
  return sum;
}

TEST(MaximumLikelihood, IsAMinimum) {
  for (const Points& p : {first_wall(), second_wall()}) {
    const FitResult fit = make_fitter("maximum_likelihood")(p, noisy);
    ASSERT_TRUE(fit.ok());
    const auto [alpha, r] = fit.estimate.line;
    const double h = 1e-5;
    const Eigen::Vector2d gradient(
        (objective(alpha + h, r, p, noisy) - objective(alpha - h, r, p, noisy)) / (2 * h),
        (objective(alpha, r + h, p, noisy) - objective(alpha, r - h, p, noisy)) / (2 * h));
    // In standard deviations of the line; the iteration ends at 1e-7.
    EXPECT_LT(std::sqrt(gradient.dot(fit.estimate.covariance * gradient)), 1e-5);
    EXPECT_GE(fit.iterations, 2);
    EXPECT_LE(fit.iterations, 10);
    for (const double angle : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
      EXPECT_GT(objective(alpha + 0.1 * std::cos(angle), r + 0.1 * std::sin(angle), p, noisy),
                objective(alpha, r, p, noisy));
    }
  }
}

TEST(MaximumLikelihood, IsConsistentForWallsThatRunPastTheSensor) {
  for (const double r : {0.0, 0.01, 0.03, 0.1, 0.3, 1.0}) {
    for (const SensorModel& sensor : {SensorModel{0.01, 0.00197, 0.0}, noisy}) {
      const NearWall wall = near_wall("maximum_likelihood", r, sensor);
      EXPECT_EQ(wall.found, 1.0) << r;
      EXPECT_NEAR(wall.nees, 2.0, 0.18) << r;  // standard deviation 2 / sqrt(2000) = 0.045
    }
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
