// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/scanner.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

TEST(CastRay, HitsWhatIsNearest) {
  World world;
  world.walls = {{{2, -1}, {2, 1}}, {{3, -5}, {3, 5}}};
  world.pillars = {{{0, 4}, 0.5}};
  EXPECT_DOUBLE_EQ(cast_ray(world, {0, 0}, {1, 0}).distance, 2.0);
  EXPECT_DOUBLE_EQ(cast_ray(world, {0, 2}, {1, 0}).distance, 3.0);
  EXPECT_DOUBLE_EQ(cast_ray(world, {0, 0}, {0, 1}).distance, 3.5);
  EXPECT_DOUBLE_EQ(cast_ray(world, {0, 4}, {0, 1}).distance, 0.5);
  EXPECT_DOUBLE_EQ(cast_ray(world, {2, 0}, {0, 1}).distance,
                   std::numeric_limits<double>::infinity());
  EXPECT_EQ(cast_ray(world, {0, 0}, {-1, 0}).distance, std::numeric_limits<double>::infinity());
  const double root = std::sqrt(0.5);
  EXPECT_NEAR(cast_ray(world, {1, 0}, {root, root}).distance, std::sqrt(2.0), 1e-12);
}

TEST(SimulatedScanner, RepeatsItselfAndVariesItsStart) {
  const World world = built_in_world("square_room").value();
  SimulatedScanner a(world, {}, 42);
  SimulatedScanner b(world, {}, 42);
  SimulatedScan first, again, next;
  a.scan(0.0, 0.0, first);
  b.scan(0.0, 0.0, again);
  a.scan(0.0, 0.0, next);
  EXPECT_EQ(first.bearings, again.bearings);
  EXPECT_EQ(first.ranges, again.ranges);
  EXPECT_NE(first.bearings, next.bearings);
  EXPECT_EQ(first.ranges.size(), 920U);
  EXPECT_FLOAT_EQ(first.time_offsets[460], 0.05F);
}

TEST(SimulatedScanner, AppliesNoiseBiasAndDropout) {
  ScannerSettings settings;
  settings.points = 4000;
  settings.noise = {0.02, 0.0, 0.0};
  settings.range_bias = 0.05;
  settings.dropout = 0.25;
  SimulatedScanner scanner(built_in_world("square_room").value(), settings, 1);
  SimulatedScan scan;
  scanner.scan(0.0, 0.0, scan);
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (std::isnan(scan.ranges[i])) continue;
    const auto bearing = static_cast<double>(scan.bearings[i]);
    const double truth = 2.0 / std::max(std::abs(std::cos(bearing)), std::abs(std::sin(bearing)));
    const double error = static_cast<double>(scan.ranges[i]) - truth;
    sum += error;
    squares += error * error;
    ++count;
  }
  EXPECT_NEAR(count, 3000, 110);  // 4 standard deviations
  const double mean = sum / count;
  EXPECT_NEAR(mean, 0.05, 0.0015);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.02, 0.001);
}

TEST(SimulatedScanner, MovesWhileItScans) {
  World world;
  world.walls = {{{10, -50}, {10, 50}}};
  world.path = {{0, 0, 0}, {8, 0, 0}};
  ScannerSettings settings;
  settings.noise = {0.0, 0.0, 0.0};
  settings.field_of_view = 1e-6;
  settings.first_bearing = 0.0;
  settings.points = 3;
  SimulatedScanner scanner(world, settings, 1);
  SimulatedScan scan;
  scanner.scan(1.0, 0.0, scan);
  EXPECT_FLOAT_EQ(scan.ranges[2], 9.0F);
  settings.field_of_view = 2.0 * pi;
  settings.points = 1000;
  SimulatedScanner full(world, settings, 1);
  full.scan(0.0, 10.0, scan);  // 1 m in a revolution
  EXPECT_NEAR(scan.ranges[998], 9.002F, 2e-3F);
  EXPECT_TRUE(std::isinf(scan.ranges[500]));
  settings.range_max = 9.5;
  SimulatedScanner near_sighted(world, settings, 1);
  near_sighted.scan(0.0, 0.0, scan);
  EXPECT_TRUE(std::isinf(scan.ranges[0]));
}

}  // namespace
}  // namespace quoin
