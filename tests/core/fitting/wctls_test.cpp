// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/fitting/algebraic.hpp"
#include "core/geometry/corner.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/fitting/published_equations.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

class AlgebraicFitter : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Names, AlgebraicFitter, testing::Values("wctls", "utls", "wtls"));

// So little noise that the bias it gives, which the equations leave out, is below rounding.
const SensorModel faint{1e-6 * noisy.range_stddev, 1e-6 * noisy.bearing_stddev, 0.0};

TEST_P(AlgebraicFitter, GivesTheCornerOfThePublishedEquations) {
  const Points p = first_wall();
  const Points q = second_wall();
  const bool weighted = std::string(GetParam()) != "utls";
  const auto a = published::implicit_line(p, faint, weighted);
  const auto b = published::implicit_line(q, faint, weighted);
  const auto expected = published::corner(a, b);
  const auto corner = intersect(make_fitter(GetParam())(p, faint).estimate,
                                make_fitter(GetParam())(q, faint).estimate);
  ASSERT_TRUE(corner);
  EXPECT_NEAR((corner->position - expected.position).norm(), 0.0, 1e-11);
  EXPECT_THAT(corner->covariance, CovarianceNear(expected.covariance, 1e-9));

  if (std::string(GetParam()) == "wctls") return;  // publishes independent contributions
  const auto literal = published::corner(published::with_common_errors(a, faint),
                                         published::with_common_errors(b, faint));
  const auto printed = intersect(make_fitter(GetParam(), "as_published")(p, faint).estimate,
                                 make_fitter(GetParam(), "as_published")(q, faint).estimate);
  EXPECT_THAT(printed->covariance, CovarianceNear(literal.covariance, 1e-9));
  EXPECT_GT(one_sigma_ellipse_area(printed->covariance),
            3.0 * one_sigma_ellipse_area(corner->covariance));
}

TEST(Wctls, GivesTheCornerOfItsConformalPoint) {
  const Points p = first_wall();
  const Points q = second_wall();
  // C_Q by exact derivatives, mapped back from (alpha, r): from Q and from the normal form it is
  // the same.
  const auto to_q = [](const LineEstimate& e) {
    const double c = std::cos(e.line.alpha);
    const double s = std::sin(e.line.alpha);
    Eigen::Matrix2d j;
    j << -s / e.line.r, -c / (e.line.r * e.line.r), -c / e.line.r, s / (e.line.r * e.line.r);
    return published::ConformalPoint{{c / e.line.r, -s / e.line.r},
                                     j * e.covariance * j.transpose()};
  };
  const LineEstimate a = make_fitter("wctls", "as_published")(p, noisy).estimate;
  const LineEstimate b = make_fitter("wctls", "as_published")(q, noisy).estimate;
  const auto expected =
      published::corner(published::normalized_line(to_q(a)), published::normalized_line(to_q(b)));
  const auto corner = intersect(a, b);
  EXPECT_NEAR((corner->position - expected.position).norm(), 0.0, 1e-12);
  EXPECT_THAT(corner->covariance, CovarianceNear(expected.covariance, 1e-9));
  // Q and C_Q found independently, differentiated numerically.
  const auto numerical = published::conformal_point(p, noisy);
  EXPECT_NEAR((numerical.q - to_q(a).q).norm(), 0.0, 1e-12);
  EXPECT_THAT(to_q(a).covariance, CovarianceNear(numerical.covariance, 1e-6));
}

// Many points, so that the scatter is small beside the bias, on a wall that is seen far from the
// foot of its perpendicular.
TEST_P(AlgebraicFitter, CountsTheBiasByNoiseOfTheBearings) {
  const SensorModel sensor{0.01, 0.0068, 0.0};
  const Line wall{0.3, 2.0};
  const Fitter fitter = make_fitter(GetParam());
  std::mt19937_64 engine(7);
  constexpr int trials = 4000;
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d reported = Eigen::Matrix2d::Zero();
  for (int trial = 0; trial < trials; ++trial) {
    const LineEstimate estimate =
        fitter(wall_points(wall, 0.8, 1.5, 600, sensor, engine), sensor).estimate;
    const Eigen::Vector2d error(estimate.line.alpha - wall.alpha, estimate.line.r - wall.r);
    bias += error / trials;
    squares += error * error.transpose() / trials;
    reported += estimate.covariance / trials;
  }
  // The bias is what the test is about, not a small thing beside the scatter.
  const Eigen::Matrix2d scatter = squares - bias * bias.transpose();
  EXPECT_GT(bias.dot(scatter.ldlt().solve(bias)), 0.3);
  // Relative standard error of a variance of so many trials: sqrt(2 / 4000) = 2 %; second order
  // leaves out a few per cent.
  EXPECT_NEAR(reported(0, 0) / squares(0, 0), 1.0, 0.15);
  EXPECT_NEAR(reported(1, 1) / squares(1, 1), 1.0, 0.15);
  EXPECT_NEAR((scatter.inverse() * reported).trace() / (scatter.inverse() * squares).trace(), 1.0,
              0.15);
}

}  // namespace
}  // namespace quoin
