// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/circle_consistency.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/circles/circle_fitters.hpp"
#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

TEST(ArcScene, ShowsTheNearSideFromOutsideAndTheFieldFromInside) {
  Points points;
  const ArcScene column{0.5, 2.0};
  observe(column, 1.0, 0.5, points);
  EXPECT_NEAR(static_cast<double>(points.size()), 2.0 * std::asin(0.25) / (2.0 * pi / 920.0), 1.0);
  const Eigen::Vector2d center(2.0 * std::cos(1.0), 2.0 * std::sin(1.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR((Eigen::Vector2d(points.x[i], points.y[i]) - center).norm(), 0.5, 1e-12);
    EXPECT_LT(points.range[i], 2.0);
  }
  observe({3.0, 1.0, 1.0}, 1.0, 0.5, points);
  EXPECT_NEAR(static_cast<double>(points.size()), 920.0 / (2.0 * pi), 1.0);
  for (const double range : points.range) EXPECT_GT(range, 3.0);
}

TEST(CramerRaoOfACircle, IsThatOfMeansAllAround) {
  // From the centre of a round room the radius is known like the mean of the ranges, and the
  // centre like twice that: the mean square of a cosine is a half.
  Points points;
  observe({2.0, 0.0}, 0.0, 0.5, points);
  const Eigen::Matrix3d bound = cramer_rao_bound({{0.0, 0.0}, 2.0}, points, {0.01, 0.002});
  const double mean = 0.01 * 0.01 / 920.0;
  EXPECT_NEAR(bound(2, 2), mean, 1e-6 * mean);
  EXPECT_NEAR(bound(0, 0), 2.0 * mean, 1e-6 * mean);
  EXPECT_NEAR(bound(0, 1), 0.0, 1e-6 * mean);
}

CircleConsistency judged(const ArcScene& scene, const SensorModel& noise) {
  return judge_circle_consistency(CircleFitters::make<CircleFitter>("maximum_likelihood", {}),
                                  scene, noise, 3000, 11);
}

TEST(CircleConsistency, IsTrueWhereTheNoiseIsSmallAgainstTheRadius) {
  SensorModel growing;
  growing.range_stddev_per_metre = 0.01;
  for (const ArcScene& scene :
       {ArcScene{0.3, 1.5}, ArcScene{1.0, 4.0}, ArcScene{3.0, 1.0}, ArcScene{3.0, 1.0, 0.8}}) {
    for (const SensorModel& noise : {SensorModel{}, SensorModel{0.003, 0.0005}, growing}) {
      const CircleConsistency result = judged(scene, noise);
      if (result.nonlinearity > 0.04) continue;
      EXPECT_EQ(result.failures[0], result.trials);
      EXPECT_NEAR(result.coverage95.value, 0.95, 0.016);  // 4 standard errors
      EXPECT_NEAR(result.coverage95_center.value, 0.95, 0.016);
      EXPECT_NEAR(result.nees.value, 3.0, 0.2);
      EXPECT_NEAR(result.rmse_over_crb.value, 1.0, 0.06);
      EXPECT_NEAR(result.radius_rmse_over_crb.value, 1.0, 0.07);
    }
  }
}

TEST(CircleConsistency, CountsWhatIsNotDetermined) {
  const CircleConsistency result = judged({0.03, 1.0}, SensorModel{});
  EXPECT_GT(result.nonlinearity, 0.2);
  EXPECT_GT(result.failures[static_cast<std::size_t>(CircleFailure::not_determined)],
            result.trials / 2);
}

TEST(CircleConsistency, RepeatsItself) {
  const CircleConsistency first = judged({0.3, 2.0}, SensorModel{});
  const CircleConsistency again = judged({0.3, 2.0}, SensorModel{});
  EXPECT_EQ(first.nees.value, again.nees.value);
  EXPECT_EQ(first.rmse_over_crb.value, again.rmse_over_crb.value);
}

}  // namespace
}  // namespace quoin
