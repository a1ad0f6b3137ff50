// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/fitters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/LU>

#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

class EveryFitter : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Names, EveryFitter, testing::ValuesIn(fitter_names()),
                         [](const auto& test) { return test.param; });

MATCHER(IsCovariance, "") {
  const Eigen::Matrix2d& c = arg;
  *result_listener << "\n" << c;
  // Rounding may leave a determinant of zero slightly negative.
  return c.allFinite() && c(0, 1) == c(1, 0) && c(0, 0) >= 0.0 && c(1, 1) >= 0.0 &&
         c.determinant() >= -1e-12 * c.trace() * c.trace();
}

TEST_P(EveryFitter, FindsExactLinesInAllDirections) {
  for (const char* covariance : {"propagated", "as_published"}) {
    for (const double alpha : {0.0, pi / 2, pi, -pi, -pi / 2, 0.3, -2.9, 3.1, pi / 4}) {
      const Points p = exact_wall_points({alpha, 2.5}, alpha - 0.5, alpha + 0.3, 40);
      const FitResult fit = make_fitter(GetParam(), covariance)(p, noisy);
      ASSERT_TRUE(fit.ok());
      EXPECT_TRUE(fit.converged);
      EXPECT_THAT(fit.estimate.line, LineNear(alpha, 2.5, 1e-12));
      EXPECT_GT(fit.estimate.line.alpha, -pi);
      EXPECT_LE(fit.estimate.line.alpha, pi);
      EXPECT_THAT(fit.estimate.covariance, IsCovariance());
    }
  }
}

TEST_P(EveryFitter, PropagatesExactDerivatives) {
  const Points p = first_wall();
  const Fitter fitter = make_fitter(GetParam());
  if (!is_efficient(GetParam())) {
    // So little noise that the bias which some count besides is below rounding.
    const SensorModel faint{1e-6 * noisy.range_stddev, 1e-6 * noisy.bearing_stddev, 0.0};
    EXPECT_THAT(fitter(p, faint).estimate.covariance,
                CovarianceNear(numerical_covariance(fitter, p, faint, faint), 1e-7));
    return;
  }
  const FitResult fit = fitter(p, noisy);
  const Eigen::Matrix2d expected = numerical_covariance(fitter, p, noisy, noisy);
  // They report the bound at their line instead, with noisy bearings, ranges or weights of the
  // starting line in it: some per cent at a range noise of 3 % and averaged over 60 points.
  const Eigen::Matrix2d bound = cramer_rao_bound(fit.estimate.line, p.bearing, noisy);
  EXPECT_THAT(fit.estimate.covariance, CovarianceNear(bound, 0.05));
  // The derivatives hold residuals of both noises besides, of order 1 / sqrt(60) of each.
  EXPECT_THAT(fit.estimate.covariance, CovarianceNear(expected, 0.25));
}

TEST_P(EveryFitter, PropagatesNoiseThatGrowsWithTheRange) {
  // 1 m of range at one end and 12 m at the other.
  const SensorModel faint{1e-5, 1e-6, 0.0, 1e-5};
  std::mt19937_64 engine(6);
  const Points p = wall_points({0.4, 1.0}, 0.4, 1.89, 60, faint, engine);
  const Fitter fitter = make_fitter(GetParam());
  const FitResult fit = fitter(p, faint);
  // One variance for all ranges is not near, whatever it is.
  const double tolerance = is_efficient(GetParam()) ? 1e-3 : 1e-6;
  EXPECT_THAT(fit.estimate.covariance,
              CovarianceNear(numerical_covariance(fitter, p, faint, faint), tolerance));
  if (is_efficient(GetParam())) {
    EXPECT_THAT(fit.estimate.covariance,
                CovarianceNear(cramer_rao_bound({0.4, 1.0}, p.bearing, faint), 1e-3));
  }
}

TEST_P(EveryFitter, TurnsWithThePoints) {
  // The regressions along an axis are not invariant, but their axes can be swapped.
  const Points p = first_wall();
  std::vector<double> bearings = p.bearing;
  for (double& bearing : bearings) bearing += pi / 2;
  for (const char* covariance : {"propagated", "as_published"}) {
    const Fitter fitter = make_fitter(GetParam(), covariance);
    const LineEstimate before = fitter(p, noisy).estimate;
    const LineEstimate after = fitter(points_from(bearings, p.range), noisy).estimate;
    EXPECT_THAT(after.line, LineNear(before.line.alpha + pi / 2, before.line.r, 1e-10));
    EXPECT_THAT(after.covariance, CovarianceNear(before.covariance, 1e-8));
  }
}

TEST_P(EveryFitter, NamesItsFailures) {
  const Fitter fitter = make_fitter(GetParam());
  const auto failure = [&](const std::vector<double>& bearings, const std::vector<double>& ranges) {
    const FitResult fit = fitter(points_from(bearings, ranges), noisy);
    EXPECT_EQ(fit.ok(), fit.converged);
    if (fit.ok()) {
      EXPECT_TRUE(std::isfinite(fit.estimate.line.alpha) && std::isfinite(fit.estimate.line.r));
      EXPECT_GE(fit.estimate.line.r, 0.0);
      EXPECT_THAT(fit.estimate.covariance, IsCovariance());
    }
    return fit.failure;
  };
  EXPECT_EQ(failure({}, {}), FitFailure::too_few_points);
  EXPECT_EQ(failure({0.1}, {1.0}), FitFailure::too_few_points);
  EXPECT_EQ(failure({0.1, 0.1, 0.1}, {1.0, 1.0, 1.0}), FitFailure::degenerate);
  EXPECT_EQ(failure({0.1, 0.2, 0.3}, {1.0, not_a_number, 1.0}), FitFailure::not_finite);
  EXPECT_EQ(failure({0.1, 0.2, 0.3}, {infinite, 1.0, 1.0}), FitFailure::not_finite);
  EXPECT_EQ(failure({0.1, 0.2, 0.3}, {1.0, 1.0, infinite}), FitFailure::not_finite);
  EXPECT_EQ(failure({0.1, 0.2, not_a_number}, {1.0, 1.0, 1.0}), FitFailure::not_finite);
  EXPECT_EQ(failure({0.1, 0.2}, {1.0, 1.0}), FitFailure::none);
  for (const double range : {1e-200, 1e-310, 1e200}) {
    EXPECT_NE(failure({0.1, 0.2, 0.3}, {range, range, range}), FitFailure::none) << range;
    failure({0.1, 0.2, 0.3}, {1.0, range, 1.0});  // either, with finite numbers
  }
}

TEST_P(EveryFitter, MeetsLinesThroughTheSensorByAnAnswerOrByName) {
  const Fitter fitter = make_fitter(GetParam());
  const bool defined = GetParam() == "cwlf" || GetParam() == "arras_siegwart" ||
                       GetParam() == "pca" || GetParam() == "least_squares" ||
                       GetParam() == "maximum_likelihood";
  for (const double bearing : {0.1, 0.0, pi / 2, pi, -2.0}) {
    for (const Points& p : {points_from({bearing, bearing, bearing}, {1.0, 1.5, 2.0}),
                            points_from({bearing, bearing + pi, bearing}, {1.0, 1.5, 2.0})}) {
      const FitResult fit = fitter(p, noisy);
      if (defined) {
        ASSERT_TRUE(fit.ok());
        EXPECT_NEAR(fit.estimate.line.r, 0.0, 1e-14);
        EXPECT_NEAR(std::cos(fit.estimate.line.alpha - bearing), 0.0, 1e-14);
        EXPECT_THAT(fit.estimate.covariance, IsCovariance());
      } else {
        EXPECT_EQ(fit.failure, FitFailure::through_sensor);
      }
    }
  }
}

TEST_P(EveryFitter, GivesAnAnswerOrANameUnderExtremeNoise) {
  std::mt19937_64 engine(11);
  const std::vector<SensorModel> models{
      {0.5, 0.05, 0.0}, {2.0, 0.0, 0.0}, {0.0, 0.1, 0.0}, {1e-9, 1e-9, 0.0}, {0.0, 0.0, 0.0}};
  for (const SensorModel& sensor : models) {
    for (int trial = 0; trial < 200; ++trial) {
      const std::size_t count = trial % 2 == 0 ? 5 : 60;
      Points p = wall_points({0.4, 1.7}, 0.0, 0.9, count, sensor, engine);
      std::vector<double> ranges = p.range;
      for (double& range : ranges) range = std::max(range, 0.05);  // nothing nearer is reported
      p = points_from(p.bearing, ranges);
      for (const char* covariance : {"propagated", "as_published"}) {
        const FitResult fit = make_fitter(GetParam(), covariance)(p, sensor);
        if (!fit.ok()) continue;
        EXPECT_TRUE(fit.converged);
        EXPECT_GT(fit.estimate.line.alpha, -pi);
        EXPECT_LE(fit.estimate.line.alpha, pi);
        EXPECT_GE(fit.estimate.line.r, 0.0);
        EXPECT_THAT(fit.estimate.covariance, IsCovariance());
      }
    }
  }
}

TEST_P(EveryFitter, TakesAModelWithoutNoise) {
  const Points p = exact_wall_points({0.4, 1.7}, 0.0, 0.9, 30);
  const std::vector<SensorModel> models{{0.0, 0.0, 0.0}, {0.0, 0.002, 0.0}, {0.01, 0.0, 0.0}};
  for (const SensorModel& sensor : models) {
    const FitResult fit = make_fitter(GetParam())(p, sensor);
    ASSERT_TRUE(fit.ok());
    EXPECT_THAT(fit.estimate.line, LineNear(0.4, 1.7, 1e-10));
    EXPECT_THAT(fit.estimate.covariance, IsCovariance());
  }
}

TEST(ChiSquare, ExpectsTwoLessThanThePoints) {
  std::mt19937_64 engine(8);
  const SensorModel sensor;
  const Fitter fitter = make_fitter("wctls");
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

TEST(LineSegmentOf, ProjectsTheEnds) {
  const Points points = exact_wall_points({0.5, 2.0}, 0.2, 0.7, 10);
  const LineSegment s = line_segment({{0.5, 2.0}, {}}, points);
  EXPECT_NEAR((s.start - Eigen::Vector2d(points.x[0], points.y[0])).norm(), 0.0, 1e-14);
  EXPECT_NEAR((s.end - Eigen::Vector2d(points.x[9], points.y[9])).norm(), 0.0, 1e-14);
  EXPECT_EQ(line_segment({}, PointsView{}).start, Eigen::Vector2d::Zero());
}

TEST_P(EveryFitter, GivesTheCovarianceAboutTheMiddle) {
  // Far away and seen from the side, (alpha, r) are correlated all but completely.
  const SensorModel sensor;
  std::mt19937_64 engine(9);
  const Points p = wall_points({0.4, 5.0}, 1.4, 1.5, 30, sensor, engine);
  const FitResult fit = make_fitter(GetParam())(p, sensor);
  const LineSegment s = line_segment(fit.estimate, fit.normal, p);
  const auto correlation = [](const Eigen::Matrix2d& c) {
    return c(0, 1) / std::sqrt(c(0, 0) * c(1, 1));
  };
  EXPECT_GT(std::abs(correlation(fit.estimate.covariance)), 0.99);
  EXPECT_LT(std::abs(correlation(s.estimate.covariance)), 0.5);
  const Eigen::Vector2d middle = 0.5 * (s.start + s.end);
  EXPECT_NEAR(s.estimate.along, middle.dot(Eigen::Vector2d(-fit.normal.y(), fit.normal.x())), 1e-9);
  EXPECT_THAT(s.estimate.about(0.0).covariance, CovarianceNear(fit.estimate.covariance, 1e-9));
}

TEST(Flatness, IsAnOffsetAndASlopeOfTheWall) {
  LineSegment wall;
  wall.estimate = {{0.0, 2.0}, Eigen::Matrix2d{{1e-6, 1e-7}, {1e-7, 1e-6}}, 1.0};
  wall.start = {2.0, 0.0};
  wall.end = {2.0, 2.0};
  LineSegment flat = wall;
  add_flatness(flat, 0.0);
  EXPECT_EQ(flat.estimate.covariance, wall.estimate.covariance);
  add_flatness(wall, 0.01);
  EXPECT_THAT(wall.estimate.covariance - flat.estimate.covariance,
              CovarianceNear(Eigen::Matrix2d{{12.0 * 1e-4 / 4.0, 0.0}, {0.0, 1e-4}}, 1e-9));
  // The mean square over the wall of an offset and a slope of these variances is twice 1e-4.
  double sum = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double t = -1.0 + (k + 0.5) / 500.0;
    sum += (flatness_covariance(0.01, 2.0)(1, 1) + t * t * flatness_covariance(0.01, 2.0)(0, 0));
  }
  EXPECT_NEAR(sum / 1000.0, 2e-4, 1e-9);
}

TEST(Flatness, CountsInTheResiduals) {
  // A wall with bumps of 5 mm that change from point to point, without any other noise.
  const Line line{0.4, 1.7};
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal;
  std::vector<double> bearings, ranges;
  for (int k = 0; k < 2000; ++k) {
    bearings.push_back(0.4 * k / 1000.0);
    ranges.push_back((line.r + 0.005 * normal(engine)) / std::cos(bearings.back() - line.alpha));
  }
  const Points p = points_from(bearings, ranges);
  // The standard deviation of a chi square over its freedom is sqrt(2 / 2000) = 0.03.
  EXPECT_NEAR(chi_square(line, p, {0.0, 0.0, 0.0, 0.0, 0.005}) / 2000.0, 1.0, 0.1);
  EXPECT_NEAR(chi_square(line, p, {0.0, 0.0, 0.0, 0.0, 0.01}) / 2000.0, 0.25, 0.03);
}

}  // namespace
}  // namespace quoin
