// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/fitters.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "core/geometry/corner.hpp"
#include "tests/core/fitting/published_equations.hpp"
#include "tests/core/matchers.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

Fitter make(const std::string& name, const char* covariance = "propagated") {
  return Fitters::make<Fitter>(name, {{"covariance", covariance}});
}

const SensorModel noisy{0.05, 0.0068, 0.0};

Points first_wall() {
  std::mt19937_64 engine(3);
  return wall_points({0.4, 1.7}, 0.1, 0.9, 60, noisy, engine);
}
Points second_wall() {
  std::mt19937_64 engine(4);
  return wall_points({1.8, 2.3}, 1.0, 1.7, 45, noisy, engine);
}

class EveryFitter : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Names, EveryFitter, testing::Values("wctls", "utls", "wtls"));

TEST_P(EveryFitter, FindsExactLinesInAllDirections) {
  for (const double alpha : {0.0, pi / 2, pi, -pi / 2, 0.3, -2.9, 3.1, pi / 4}) {
    const Points p = exact_wall_points({alpha, 2.5}, alpha - 0.5, alpha + 0.3, 40);
    const FitResult fit = make(GetParam())(p, noisy);
    ASSERT_TRUE(fit.ok());
    EXPECT_THAT(fit.estimate.line, LineNear(alpha, 2.5, 1e-12));
    EXPECT_GT(fit.estimate.line.alpha, -pi);
    EXPECT_LE(fit.estimate.line.alpha, pi);
  }
}

TEST_P(EveryFitter, PropagatesExactDerivatives) {
  const Points p = first_wall();
  const Fitter fitter = make(GetParam());
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
  const double h = 1e-6;
  const auto moved = [&](std::size_t i, double d_range, double d_bearing) {
    std::vector<double> bearings = p.bearing;
    std::vector<double> ranges = p.range;
    bearings[i] += d_bearing;
    ranges[i] += d_range;
    const Line line = fitter(points_from(bearings, ranges), noisy).estimate.line;
    return Eigen::Vector2d(line.alpha, line.r);
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d g = (moved(i, h, 0) - moved(i, -h, 0)) / (2 * h) * noisy.range_stddev;
    const Eigen::Vector2d k = (moved(i, 0, h) - moved(i, 0, -h)) / (2 * h) * noisy.bearing_stddev;
    expected += g * g.transpose() + k * k.transpose();
  }
  EXPECT_THAT(fitter(p, noisy).estimate.covariance, CovarianceNear(expected, 1e-7));
}

TEST_P(EveryFitter, GivesTheCornerOfThePublishedEquations) {
  const Points p = first_wall();
  const Points q = second_wall();
  const bool weighted = std::string(GetParam()) != "utls";
  const auto a = published::implicit_line(p, noisy, weighted);
  const auto b = published::implicit_line(q, noisy, weighted);
  const auto expected = published::corner(a, b);
  const auto corner =
      intersect(make(GetParam())(p, noisy).estimate, make(GetParam())(q, noisy).estimate);
  ASSERT_TRUE(corner);
  EXPECT_NEAR((corner->position - expected.position).norm(), 0.0, 1e-11);
  EXPECT_THAT(corner->covariance, CovarianceNear(expected.covariance, 1e-9));

  if (std::string(GetParam()) == "wctls") return;  // publishes the propagated one
  const auto literal = published::corner(published::with_common_errors(a, noisy),
                                         published::with_common_errors(b, noisy));
  const auto printed = intersect(make(GetParam(), "as_published")(p, noisy).estimate,
                                 make(GetParam(), "as_published")(q, noisy).estimate);
  EXPECT_THAT(printed->covariance, CovarianceNear(literal.covariance, 1e-9));
  EXPECT_GT(one_sigma_ellipse_area(printed->covariance),
            3.0 * one_sigma_ellipse_area(corner->covariance));
}

TEST(Wctls, GivesTheCornerOfItsConformalPoint) {
  const Points p = first_wall();
  const Points q = second_wall();
  // C_Q by exact influences, mapped back from (alpha, r): from Q and from the normal form it is the
  // same.
  const auto to_q = [](const LineEstimate& e) {
    const double c = std::cos(e.line.alpha);
    const double s = std::sin(e.line.alpha);
    Eigen::Matrix2d j;
    j << -s / e.line.r, -c / (e.line.r * e.line.r), -c / e.line.r, s / (e.line.r * e.line.r);
    return published::ConformalPoint{{c / e.line.r, -s / e.line.r},
                                     j * e.covariance * j.transpose()};
  };
  const LineEstimate a = make("wctls")(p, noisy).estimate;
  const LineEstimate b = make("wctls")(q, noisy).estimate;
  const auto expected =
      published::corner(published::normalized_line(to_q(a)), published::normalized_line(to_q(b)));
  const auto corner = intersect(a, b);
  EXPECT_NEAR((corner->position - expected.position).norm(), 0.0, 1e-12);
  EXPECT_THAT(corner->covariance, CovarianceNear(expected.covariance, 1e-9));
  // Q and C_Q found independently, differentiated numerically.
  const auto numerical = published::conformal_point(p, noisy);
  EXPECT_NEAR((numerical.q - to_q(a).q).norm(), 0.0, 1e-12);
  EXPECT_THAT(to_q(a).covariance, CovarianceNear(numerical.covariance, 1e-6));
  EXPECT_EQ(make("wctls", "as_published")(p, noisy).estimate.covariance, a.covariance);
}

TEST_P(EveryFitter, NamesItsFailures) {
  const Fitter fitter = make(GetParam());
  const auto failure = [&](const std::vector<double>& bearings, const std::vector<double>& ranges) {
    return fitter(points_from(bearings, ranges), noisy).failure;
  };
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(failure({}, {}), FitFailure::too_few_points);
  EXPECT_EQ(failure({0.1}, {1.0}), FitFailure::too_few_points);
  EXPECT_EQ(failure({0.1, 0.1, 0.1}, {1.0, 1.0, 1.0}), FitFailure::degenerate);
  EXPECT_EQ(failure({0.1, 0.1, 0.1}, {1.0, 1.5, 2.0}), FitFailure::through_sensor);
  EXPECT_EQ(failure({0.1, 0.1 + pi, 0.1}, {1.0, 1.5, 2.0}), FitFailure::through_sensor);
  EXPECT_EQ(failure({0.1, 0.2, 0.3}, {1.0, not_a_number, 1.0}), FitFailure::not_finite);
  EXPECT_EQ(failure({0.1, 0.2, not_a_number}, {1.0, 1.0, 1.0}), FitFailure::not_finite);
  EXPECT_EQ(failure({0.1, 0.2}, {1.0, 1.0}), FitFailure::none);
  const FitResult tiny = fitter(points_from({0.1, 0.2, 0.3}, {1e-200, 1e-200, 1e-200}), noisy);
  EXPECT_FALSE(tiny.ok());
  EXPECT_FALSE(tiny.converged);
}

TEST(ChiSquare, ExpectsTwoLessThanThePoints) {
  std::mt19937_64 engine(8);
  const SensorModel sensor;
  const Fitter fitter = make("wctls");
  double sum = 0.0;
  const int trials = 2000;
  for (int k = 0; k < trials; ++k) {
    const Points p = wall_points({0.4, 1.7}, 0.0, 0.8, 40, sensor, engine);
    sum += chi_square(fitter(p, sensor).estimate.line, p, sensor);
  }
  // Mean 38, standard deviation of the mean sqrt(76 / 2000) = 0.2.
  EXPECT_NEAR(sum / trials, 38.0, 0.9);
  EXPECT_EQ(
      chi_square({0.4, 1.7}, exact_wall_points({0.4, 1.7}, 0.0, 0.8, 3), {0.0, 0.0, 0.0}) >= 0.0,
      true);
}

}  // namespace
}  // namespace quoin
