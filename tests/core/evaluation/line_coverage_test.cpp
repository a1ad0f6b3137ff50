// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/line_coverage.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/fitting/fitters.hpp"

namespace quoin {
namespace {

const Fitter& inverse_range() {
  static const Fitter fitter = Fitters::make<Fitter>("inverse_range", {});
  return fitter;
}

LineCoverage judge(const SingleWall& wall, double range_stddev,
                   const Fitter& fitter = inverse_range()) {
  SensorModel noise;
  noise.range_stddev = range_stddev;
  return judge_wall(fitter, wall, noise, 920, 5, 10000, 11);
}

// The standard error of 10000 trials is 0.2 %.
TEST(LineCoverage, IsTrueInTheMiddleOfShortAndFarWalls) {
  const LineCoverage near = judge({1.0, 2.0, 0.7}, 0.01);
  EXPECT_EQ(near.trials, 10000U);
  EXPECT_EQ(near.few_rays, 0U);
  EXPECT_NEAR(near.middle.value, 0.95, 0.008);
  EXPECT_NEAR(near.alpha_r.value, 0.95, 0.008);
  EXPECT_EQ(near.gaussian, 1.0);

  // 0.3 m, 4 m away, face on: (alpha, r) is not Gaussian, and most lines say so.
  for (const double stddev : {0.01, 0.03}) {
    const LineCoverage far = judge({0.3, 4.0, 0.0}, stddev);
    EXPECT_NEAR(far.points, 11.0, 0.5);
    EXPECT_NEAR(far.middle.value, 0.95, 0.01) << stddev;
    EXPECT_LT(far.gaussian, 0.1) << stddev;
  }
}

TEST(LineCoverage, SeesCovariancesThatAreTooSmall) {
  const Fitter boastful = [](const PointsView& points, const SensorModel& sensor) {
    FitResult result = inverse_range()(points, sensor);
    result.estimate.covariance *= 0.25;
    return result;
  };
  // P(chi^2_2 < 5.99 / 4) = 0.527.
  EXPECT_NEAR(judge({1.0, 2.0, 0.7}, 0.01, boastful).middle.value, 0.527, 0.02);
}

TEST(LineCoverage, CountsWallsThatTooFewRaysMeet) {
  const LineCoverage none = judge({0.2, 10.0, 0.0}, 0.01);
  EXPECT_EQ(none.trials, 0U);
  EXPECT_EQ(none.few_rays, 10000U);
  // 0.0068 rad apart: four or five rays, as the first one falls.
  const LineCoverage some = judge({0.3, 10.0, 0.0}, 0.01);
  EXPECT_GT(some.few_rays, 0U);
  EXPECT_GT(some.trials, 0U);
}

}  // namespace
}  // namespace quoin
