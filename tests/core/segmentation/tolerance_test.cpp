// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/tolerance.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

Points far_and_near() { return points_from({0.0, 0.01, 0.02}, {2.0, 20.0, 2.0}); }

TEST(Tolerance, IsTheDistanceWhereNoiseIsSmall) {
  const Tolerance tolerance({}, {0.001, 0.0001, 0.0}, far_and_near());
  EXPECT_FALSE(tolerance.raised());
  EXPECT_DOUBLE_EQ(std::sqrt(tolerance.squared(1.0, 2.0, 0.0)), 0.05);
}

TEST(Tolerance, GrowsWithNoiseAlongAndAcrossTheRay) {
  const Tolerance tolerance({}, {0.03, 0.002, 0.0}, far_and_near());
  EXPECT_TRUE(tolerance.raised());
  // Four standard deviations: of the range where the ray meets the line head on, of the bearing
  // times the range where it grazes it.
  EXPECT_NEAR(std::sqrt(tolerance.squared(1.0, 20.0, 0.0)), 0.12, 1e-12);
  EXPECT_NEAR(std::sqrt(tolerance.squared(0.0, 0.0, 20.0)), 0.16, 1e-12);
  EXPECT_NEAR(std::sqrt(tolerance.squared(0.0, 0.0, 2.0)), 0.05, 1e-12);
  EXPECT_NEAR(std::sqrt(tolerance.largest), 0.16, 1e-12);
}

TEST(Tolerance, GrowsWithTheRange) {
  const Tolerance tolerance({}, {0.0, 0.0, 0.0, 0.01}, far_and_near());
  // Four times 1 % of the range along the ray, by the cosine of the incidence angle.
  EXPECT_NEAR(std::sqrt(tolerance.squared(1.0, 20.0, 0.0)), 0.8, 1e-12);
  EXPECT_NEAR(std::sqrt(tolerance.squared(0.5, 10.0, 17.0)), 0.4, 1e-12);
  EXPECT_NEAR(std::sqrt(tolerance.squared(1.0, 1.0, 0.0)), 0.05, 1e-12);
  EXPECT_NEAR(std::sqrt(tolerance.largest), 0.8, 1e-12);
}

TEST(FarthestFrom, MeasuresBeyondTheTolerance) {
  // On the line x = 1 but for two points: one near with 0.1 m, one far along with 0.15 m.
  const Points points =
      points_from({0.0, 0.1, 0.2, std::atan2(20.0, 1.15)},
                  {1.1, 1.0 / std::cos(0.1), 1.0 / std::cos(0.2), std::hypot(20.0, 1.15)});
  const NormalLine line{1.0, 0.0, 1.0};
  const FarthestPoint plain =
      farthest_from(line, points, Tolerance({}, {0.001, 0.0001, 0.0}, points));
  EXPECT_EQ(plain.index, 3U);
  EXPECT_NEAR(plain.excess, 0.15 * 0.15 - 0.05 * 0.05, 1e-9);
  // Bearing noise explains the far point: 4 * 0.002 * 20 = 0.16 m.
  const FarthestPoint aware =
      farthest_from(line, points, Tolerance({}, {0.001, 0.002, 0.0}, points));
  EXPECT_EQ(aware.index, 0U);
  EXPECT_NEAR(aware.excess, 0.1 * 0.1 - 0.05 * 0.05, 1e-9);
}

}  // namespace
}  // namespace quoin
