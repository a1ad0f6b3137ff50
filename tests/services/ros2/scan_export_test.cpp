// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/scan_export.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::ros2 {
namespace {

using std::numbers::pi;

/// `count` rays over a whole turn from `first` [rad] on, whose ranges [m] are 1, 2, 3, ...
msg::Scan turn(std::size_t count, double first, double direction = 1.0) {
  msg::Scan scan;
  scan.header().frame("laser");
  scan.header().stamp(1'700'000'000'000'000'000);
  scan.range_min(0.1F);
  scan.range_max(1e4F);
  scan.duration(0.1F);
  for (std::size_t i = 0; i < count; ++i) {
    const double step = 2.0 * pi / static_cast<double>(count);
    scan.bearings().push_back(
        static_cast<float>(first + direction * step * static_cast<double>(i)));
    scan.ranges().push_back(static_cast<float>(i + 1));
  }
  return scan;
}

TEST(ScanExport, ARegularScanKeepsAllItsRays) {
  for (const double direction : {1.0, -1.0}) {
    ScanExport beams(0);
    LaserScan out;
    const msg::Scan in = turn(360, 0.3, direction);
    ASSERT_TRUE(beams.convert(in, out));
    ASSERT_EQ(out.ranges().size(), 360U);
    for (std::size_t i = 0; i < 360; ++i) {
      const double bearing = out.angle_min() + static_cast<double>(i) * out.angle_increment();
      const double ray = direction * (bearing - 0.3) / (2.0 * pi) * 360.0;
      const auto number = static_cast<int>(std::lround(ray + 720.0)) % 360;
      EXPECT_EQ(out.ranges()[i], static_cast<float>(number + 1)) << i;
    }
    EXPECT_GE(out.angle_min(), -pi - 1e-6);
    EXPECT_LT(out.angle_min(), -pi + 2.0 * pi / 360.0);
    EXPECT_NEAR(out.angle_max(), out.angle_min() + 359.0 / 360.0 * 2.0 * pi, 1e-5);
  }
}

TEST(ScanExport, BeamsStayTheSameWhileRaysChangeAndNoRangeIsInvented) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004);
  std::uniform_int_distribution<std::size_t> number(300, 420);
  ScanExport beams(360);
  LaserScan out;
  std::optional<float> first_angle;
  for (int k = 0; k < 20; ++k) {
    msg::Scan in = turn(number(random), -1.0 + jitter(random));
    for (float& bearing : in.bearings()) bearing += static_cast<float>(jitter(random));
    ASSERT_TRUE(beams.convert(in, out));
    ASSERT_EQ(out.ranges().size(), 360U);
    if (!first_angle) first_angle = out.angle_min();
    EXPECT_EQ(out.angle_min(), *first_angle);
    for (std::size_t i = 0; i < 360; ++i) {
      const float range = out.ranges()[i];
      if (std::isnan(range)) continue;
      // It is that of a ray, which is not farther off than half a beam; none other is nearer.
      const auto ray = static_cast<std::size_t>(range) - 1;
      const double beam = out.angle_min() + static_cast<double>(i) * out.angle_increment();
      const auto off = [&](std::size_t r) {
        return std::abs(std::remainder(static_cast<double>(in.bearings()[r]) - beam, 2.0 * pi));
      };
      EXPECT_LE(off(ray), 0.5 * out.angle_increment() + 1e-6);
      for (std::size_t other = 0; other < in.ranges().size(); ++other) {
        ASSERT_GE(off(other), off(ray) - 1e-6);
      }
    }
  }
}

TEST(ScanExport, ABeamWithoutARayIsNaNAndRangesAreWhatRep117Says) {
  msg::Scan in = turn(8, -pi);
  ScanExport beams(16);
  LaserScan out;
  constexpr float inf = std::numeric_limits<float>::infinity();
  in.ranges() = {inf, -inf, 0.0F, 2e4F, 0.05F, 6.0F, std::numeric_limits<float>::quiet_NaN(), 8.0F};
  ASSERT_TRUE(beams.convert(in, out));
  using testing::IsNan;
  EXPECT_THAT(out.ranges(),
              testing::ElementsAre(inf, IsNan(), -inf, IsNan(), IsNan(), IsNan(), inf, IsNan(),
                                   -inf, IsNan(), 6.0F, IsNan(), IsNan(), IsNan(), 8.0F, IsNan()));
}

TEST(ScanExport, ASectorKeepsItsLimits) {
  for (const double direction : {1.0, -1.0}) {
    msg::Scan in;
    in.header().frame("laser");
    in.range_max(1000.0F);
    for (int i = 0; i <= 270; ++i) {
      in.bearings().push_back(static_cast<float>(direction * (i - 135) * pi / 180.0));
      in.ranges().push_back(static_cast<float>(i + 1));
    }
    ScanExport beams(0);
    LaserScan out;
    ASSERT_TRUE(beams.convert(in, out));
    EXPECT_NEAR(out.angle_min(), -135.0 * pi / 180.0, 1e-5);
    EXPECT_NEAR(out.angle_max(), 135.0 * pi / 180.0, 1e-5);
    ASSERT_EQ(out.ranges().size(), 271U);
    EXPECT_EQ(out.ranges().front(), direction > 0 ? 1.0F : 271.0F);
    EXPECT_EQ(out.ranges().back(), direction > 0 ? 271.0F : 1.0F);
  }
}

TEST(ScanExport, BeamsHaveTimesOnlyInTheOrderOfAcquisition) {
  LaserScan out;
  ScanExport in_order(0);
  ASSERT_TRUE(in_order.convert(turn(360, -pi), out));
  EXPECT_NEAR(out.time_increment(), 0.1 / 359.0, 1e-9);
  ScanExport clockwise(0);
  ASSERT_TRUE(clockwise.convert(turn(360, pi, -1.0), out));
  EXPECT_EQ(out.time_increment(), 0.0F);
  ScanExport from_ahead(0);
  ASSERT_TRUE(from_ahead.convert(turn(360, 0.0), out));
  EXPECT_EQ(out.time_increment(), 0.0F);
}

TEST(ScanExport, WaitsForAScanThatSaysWhereBeamsAre) {
  ScanExport beams(0);
  LaserScan out;
  EXPECT_FALSE(beams.convert(msg::Scan(), out));
  msg::Scan one_direction;
  one_direction.bearings({1.0F, 1.0F, 1.0F});
  one_direction.ranges({1.0F, 1.0F, 1.0F});
  EXPECT_FALSE(beams.convert(one_direction, out));
  EXPECT_TRUE(beams.convert(turn(100, 0.0), out));
  // From now on an empty one has the same beams.
  ASSERT_TRUE(beams.convert(msg::Scan(), out));
  EXPECT_EQ(out.ranges().size(), 100U);
}

}  // namespace
}  // namespace quoin::ros2
