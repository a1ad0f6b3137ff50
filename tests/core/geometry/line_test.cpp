// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/line.hpp"

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
}

}  // namespace
}  // namespace quoin
