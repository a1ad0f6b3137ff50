// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/line.hpp"

#include <random>

#include <Eigen/LU>

#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

TEST(Line, NormalPointsFromTheSensorToTheLine) {
  const Line line{pi / 2, 2.0};  // y = 2
  EXPECT_NEAR(line.normal().x(), 0.0, 1e-15);
  EXPECT_NEAR(line.normal().y(), 1.0, 1e-15);
}

TEST(Normalized, TurnsNegativeDistancesAround) {
  LineEstimate estimate{{0.5, -2.0}, Eigen::Matrix2d{{1.0, 0.3}, {0.3, 2.0}}};
  const LineEstimate n = normalized(estimate);
  EXPECT_THAT(n.line, LineNear(0.5 - pi, 2.0, 1e-15));
  EXPECT_THAT(n.covariance, CovarianceNear(Eigen::Matrix2d{{1.0, -0.3}, {-0.3, 2.0}}, 1e-15));
  EXPECT_DOUBLE_EQ(normalized({{-pi, 1.0}, {}}).line.alpha, pi);
  EXPECT_NEAR(normalized({{7.0 * pi, 1.0}, {}}).line.alpha, pi, 1e-14);
  EXPECT_DOUBLE_EQ(normalized({{0.0, 1.0}, {}}).line.alpha, 0.0);
  EXPECT_DOUBLE_EQ(normalized({{0.5, -2.0}, {}, 3.0}).along, -3.0);
}

TEST(LineEstimate, HasItsCovarianceAboutAnyPointOfIt) {
  const LineEstimate middle{{0.5, 2.0}, Eigen::Matrix2d{{4e-4, 1e-5}, {1e-5, 1e-4}}, 3.0};
  // Two metres on, an error of the direction moves the line against its normal.
  const LineEstimate other = middle.about(5.0);
  EXPECT_DOUBLE_EQ(other.along, 5.0);
  EXPECT_DOUBLE_EQ(other.covariance(0, 0), 4e-4);
  EXPECT_DOUBLE_EQ(other.covariance(0, 1), 1e-5 - 2.0 * 4e-4);
  EXPECT_DOUBLE_EQ(other.covariance(1, 1), 1e-4 - 4.0 * 1e-5 + 4.0 * 4e-4);
  EXPECT_DOUBLE_EQ(middle.offset_variance(5.0), other.covariance(1, 1));
  EXPECT_THAT(other.about(3.0).covariance, CovarianceNear(middle.covariance, 1e-12));
}

/// How often the 95 % ellipse of this covariance of (alpha, r) holds the truth, a wall being seen
/// about its mid-point `along` from the foot of the perpendicular.
double coverage_of_alpha_r(const LineEstimate& truth, const Eigen::Matrix2d& covariance) {
  const double direction = std::sqrt(truth.covariance(0, 0));
  const double offset = std::sqrt(truth.covariance(1, 1));
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  const Eigen::Matrix2d information = covariance.inverse();
  int inside = 0;
  constexpr int trials = 40000;
  for (int k = 0; k < trials; ++k) {
    const double turn = direction * normal(engine);
    // The mid-point is at (r + offset, along) in the frame of the true normal.
    const double r =
        (truth.line.r + offset * normal(engine)) * std::cos(turn) + truth.along * std::sin(turn);
    const Eigen::Vector2d error(turn, r - truth.line.r);
    inside += error.dot(information * error) <= chi_square_2_95 ? 1 : 0;
  }
  return static_cast<double>(inside) / trials;
}

double coverage_of_alpha_r(const LineEstimate& truth) {
  return coverage_of_alpha_r(truth, truth.alpha_r_covariance());
}

TEST(LineEstimate, KnowsWhenAlphaAndRAreNotGaussian) {
  // 0.3 m of wall 4 m away: 18 points of 10 mm of noise are 1.6 deg and 2.4 mm.
  const auto seen = [](double direction, double offset, double r, double along) {
    return LineEstimate{
        {0.3, r}, Eigen::Vector2d(direction * direction, offset * offset).asDiagonal(), along};
  };
  const LineEstimate facing = seen(0.028, 0.0024, 4.0, 0.0);
  EXPECT_FALSE(facing.is_gaussian_in_alpha_r());
  // The probabilities of the parabola, by integration: 0.864 with the first order alone, and 0.930.
  EXPECT_NEAR(coverage_of_alpha_r(facing, facing.about(0.0).covariance), 0.864, 0.006);
  EXPECT_NEAR(coverage_of_alpha_r(facing), 0.930, 0.005);
  // Half as far; and the same from the side, where the distance along the line decides.
  for (const LineEstimate& gaussian : {seen(0.014, 0.0024, 4.0, 0.0), seen(0.014, 0.0024, 3.0, 3.0),
                                       seen(0.028, 0.0024, 0.2, 4.0)}) {
    EXPECT_TRUE(gaussian.is_gaussian_in_alpha_r());
    EXPECT_NEAR(coverage_of_alpha_r(gaussian), 0.95, 0.01);
  }
  // At the limit it is 94 %, whatever the scale; the standard error is 0.12 %.
  const double limit = std::sqrt(std::sqrt(0.38 / 0.75));
  for (const double scale : {1.0, 10.0}) {
    const LineEstimate at_limit = seen(limit * 1e-2, 1e-4 * scale, scale, 2.0);
    EXPECT_NEAR(coverage_of_alpha_r(at_limit), 0.94, 0.004);
    EXPECT_TRUE(seen(0.999 * limit * 1e-2, 1e-4 * scale, scale, 2.0).is_gaussian_in_alpha_r());
    EXPECT_FALSE(seen(1.001 * limit * 1e-2, 1e-4 * scale, scale, 2.0).is_gaussian_in_alpha_r());
  }
}

}  // namespace
}  // namespace quoin
