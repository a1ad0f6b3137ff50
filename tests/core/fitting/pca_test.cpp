// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

#include "core/fitting/orthogonal.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

TEST(Pca, FollowsThePrincipalComponent) {
  const Points p = second_wall();
  const auto n = static_cast<double>(p.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) mean += Eigen::Vector2d(p.x[i], p.y[i]) / n;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d d = Eigen::Vector2d(p.x[i], p.y[i]) - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
  const LineEstimate e = make_fitter("pca", "as_published")(p, noisy).estimate;
  const Eigen::Vector2d normal = e.line.normal();
  EXPECT_NEAR(normal.dot(solver.eigenvectors().col(1)), 0.0, 1e-12);
  EXPECT_NEAR(normal.dot(mean), e.line.r, 1e-12);

  // Residuals across the line give the scale; orientation and offset at the mean are independent.
  const double variance = solver.eigenvalues()(0) / (n - 2.0);
  const double t = normal.x() * mean.y() - normal.y() * mean.x();
  const double alpha_variance = variance / solver.eigenvalues()(1);
  Eigen::Matrix2d expected;
  expected << alpha_variance, t * alpha_variance, t * alpha_variance,
      variance / n + t * t * alpha_variance;
  EXPECT_THAT(e.covariance, CovarianceNear(expected, 1e-9));
}

TEST(Pca, NeedsThreePointsForItsResiduals) {
  const Points two = points_from({0.1, 0.2}, {1.0, 1.0});
  EXPECT_EQ(make_fitter("pca", "as_published")(two, noisy).failure, FitFailure::too_few_points);
  EXPECT_TRUE(make_fitter("pca")(two, noisy).ok());
}

TEST(Pca, IsBiasedAsTheoryHasIt) {
  // Range noise moves a point along its ray, across and along the wall at once: the expectation of
  // that product turns the line by -sum(cos sin) sr^2 / sum t^2.
  const Line truth{0.4, 1.7};
  const SensorModel sensor{0.05, 0.0, 0.0};
  const Points exact = exact_wall_points(truth, 0.7, 1.3, 40);
  double mean = 0.0;
  double cross = 0.0;
  for (const double bearing : exact.bearing) {
    mean += truth.r * std::tan(bearing - truth.alpha) / 40.0;
    cross += std::cos(bearing - truth.alpha) * std::sin(bearing - truth.alpha);
  }
  double squares = 0.0;
  for (const double bearing : exact.bearing) {
    const double t = truth.r * std::tan(bearing - truth.alpha) - mean;
    squares += t * t;
  }
  const double expected = -cross * sensor.range_stddev * sensor.range_stddev / squares;
  std::mt19937_64 engine(12);
  const Fitter fitter = make_fitter("pca");
  const int trials = 20000;
  double sum = 0.0;
  double variance = 0.0;
  for (int k = 0; k < trials; ++k) {
    const LineEstimate e =
        fitter(wall_points(truth, 0.7, 1.3, 40, sensor, engine), sensor).estimate;
    sum += e.line.alpha - truth.alpha;
    variance += e.covariance(0, 0) / trials;
  }
  const double error_of_mean = std::sqrt(variance / trials);
  EXPECT_GT(std::abs(expected), 10.0 * error_of_mean);
  // To first order in sr^2: the next one is smaller by sr^2 n / sum t^2, 2 %, times a few.
  EXPECT_NEAR(sum / trials, expected, 4.0 * error_of_mean + 0.1 * std::abs(expected));
}

}  // namespace
}  // namespace quoin
