// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "core/fitting/axis_regression.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

/// alpha and r of y = m x + c, or of x = m y + c.
Eigen::Vector2d normal_form(const Eigen::Vector2d& mc, bool y_on_x) {
  const double norm = std::hypot(1.0, mc(0));
  const double sign = mc(1) < 0.0 ? -1.0 : 1.0;
  const double alpha = y_on_x ? std::atan2(sign, -sign * mc(0)) : std::atan2(-sign * mc(0), sign);
  return {alpha, sign * mc(1) / norm};
}

TEST(LeastSquares, IsTheTextbookRegression) {
  for (const double alpha : {0.4, 1.3, 2.0, 2.9, -0.4, -1.8}) {
    std::mt19937_64 engine(9);
    const Points p = wall_points({alpha, 1.7}, alpha - 0.3, alpha + 0.6, 60, noisy, engine);
    const bool y_on_x = std::abs(std::sin(alpha)) > std::abs(std::cos(alpha));
    const auto n = static_cast<Eigen::Index>(p.size());
    Eigen::MatrixX2d a(n, 2);
    a.col(0) = Eigen::Map<const Eigen::VectorXd>((y_on_x ? p.x : p.y).data(), n);
    a.col(1).setOnes();
    const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>((y_on_x ? p.y : p.x).data(), n);
    const Eigen::Vector2d mc = a.colPivHouseholderQr().solve(b);
    const double variance = (b - a * mc).squaredNorm() / static_cast<double>(n - 2);
    const Eigen::Matrix2d covariance = variance * (a.transpose() * a).inverse();

    Eigen::Matrix2d jacobian;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d h = 1e-6 * Eigen::Vector2d::Unit(k);
      jacobian.col(k) = (normal_form(mc + h, y_on_x) - normal_form(mc - h, y_on_x)) / 2e-6;
    }
    const LineEstimate e = make_fitter("least_squares", "as_published")(p, noisy).estimate;
    const Eigen::Vector2d expected = normal_form(mc, y_on_x);
    EXPECT_THAT(e.line, LineNear(expected(0), expected(1), 1e-11));
    EXPECT_THAT(e.covariance, CovarianceNear(jacobian * covariance * jacobian.transpose(), 1e-7));
  }
}

TEST(LeastSquares, NeedsThreePointsForItsResiduals) {
  const Points two = points_from({0.1, 0.2}, {1.0, 1.0});
  EXPECT_EQ(make_fitter("least_squares", "as_published")(two, noisy).failure,
            FitFailure::too_few_points);
  EXPECT_TRUE(make_fitter("least_squares")(two, noisy).ok());
}

}  // namespace
}  // namespace quoin
