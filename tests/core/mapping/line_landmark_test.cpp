// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/line_landmark.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace quoin {
namespace {

LineMeasurement example() {
  LineMeasurement m;
  m.alpha = 0.7;
  m.middle = {2.0, 1.0};
  m.half_length = 0.5;
  return m;
}

TEST(LineMeasurement, HasTheCovarianceAboutTheMiddle) {
  // alpha and r of a wall at x = 2 from y = 3 to 5, whose direction and whose middle were measured
  // independently: dr = d(offset) + t dalpha with t = 4.
  LineSegment line;
  line.start = {2.0, 3.0};
  line.end = {2.0, 5.0};
  line.estimate.line = {0.0, 2.0};
  const double direction = 1e-4, offset = 4e-6, t = 4.0;
  line.estimate.covariance << direction, t * direction, t * direction, offset + t * t * direction;
  const LineMeasurement m = line_measurement(line, 0.0);
  EXPECT_NEAR(m.half_length, 1.0, 1e-12);
  EXPECT_NEAR(m.covariance(0, 0), direction, 1e-15);
  EXPECT_NEAR(m.covariance(0, 1), 0.0, 1e-15);
  EXPECT_NEAR(m.covariance(1, 1), offset, 1e-15);
  // 2 m of wall that are uneven by 10 mm: 12 / length^2 of the variance for the direction.
  const LineMeasurement uneven = line_measurement(line, 0.01);
  EXPECT_NEAR(uneven.covariance(0, 0) - direction, 3e-4, 1e-12);
  EXPECT_NEAR(uneven.covariance(1, 1) - offset, 1e-4, 1e-12);
}

TEST(LineResidual, HasTheDerivativesOfCentralDifferences) {
  const LineMeasurement m = example();
  const Pose2 pose{0.3, -0.4, 0.5};
  LineLandmark landmark = landmark_of({0.2, -0.5, 0.45}, m);
  landmark.offset = 0.1;
  const LineResidual residual = line_residual(pose, landmark, m);
  constexpr double h = 1e-6;
  for (int i = 0; i < 5; ++i) {
    const auto at = [&](double by) {
      Pose2 p = pose;
      LineLandmark l = landmark;
      (i == 0 ? p.x : i == 1 ? p.y : i == 2 ? p.theta : i == 3 ? l.phi : l.offset) += by;
      return line_residual(p, l, m).value;
    };
    const Eigen::Vector2d numeric = (at(h) - at(-h)) / (2 * h);
    const Eigen::Vector2d analytic = i < 3 ? Eigen::Vector2d(residual.by_pose.col(i))
                                           : Eigen::Vector2d(residual.by_landmark.col(i - 3));
    EXPECT_NEAR((numeric - analytic).norm(), 0.0, 1e-8) << i;
  }
}

TEST(LineLandmark, IsMetWhereItWasSeen) {
  const LineMeasurement m = example();
  const Pose2 pose{0.3, -0.4, 0.5};
  LineLandmark landmark = landmark_of(pose, m);
  EXPECT_NEAR(line_residual(pose, landmark, m).value.norm(), 0.0, 1e-12);
  EXPECT_NEAR(overlap(pose, landmark, m), 1.0, 1e-12);
  LineMeasurement beside = m;
  beside.middle += 1.5 * Eigen::Vector2d(-std::sin(m.alpha), std::cos(m.alpha));
  EXPECT_NEAR(overlap(pose, landmark, beside), -0.5, 1e-12);
  extend(landmark, pose, beside);
  EXPECT_NEAR(landmark.length(), 2.5, 1e-12);
  EXPECT_NEAR(overlap(pose, landmark, beside), 1.0, 1e-12);
}

}  // namespace
}  // namespace quoin
