// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "core/geometry/angle.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {
namespace {

using testing::ElementsAre;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

Points converted(const std::vector<float>& bearings, const std::vector<float>& ranges) {
  Points points;
  const std::size_t count = convert({bearings, ranges, 0.1F, 40.0F}, points);
  EXPECT_EQ(count, points.size());
  return points;
}

TEST(Convert, DropsInvalidPoints) {
  const Points p =
      converted({0.0F, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, nan_value, infinite, 0.9F},
                {1.0F, nan_value, infinite, -infinite, 0.0F, -1.0F, 0.05F, 1.0F, 1.0F, 41.0F});
  EXPECT_THAT(p.range, ElementsAre(1.0));
  EXPECT_THAT(p.x, ElementsAre(1.0));
}

TEST(Convert, TakesNothingAndTheShorterOfTwo) {
  EXPECT_EQ(converted({}, {}).size(), 0U);
  EXPECT_EQ(converted({0.1F}, {nan_value}).size(), 0U);
  EXPECT_EQ(converted({0.1F, 0.2F, 0.3F}, {1.0F}).size(), 1U);
  EXPECT_EQ(converted({0.1F, 0.1F}, {1.0F, 1.0F}).size(), 2U);
}

TEST(Convert, KeepsTheNaturalStartOfASector) {
  // A wall seen under half a turn, both ends of the scan into the void.
  const Points p =
      converted({-1.5F, -1.0F, -0.95F, 0.0F, 0.05F, 1.5F}, {5.0F, 2.0F, 2.1F, 1.0F, 1.1F, 6.0F});
  EXPECT_NEAR(p.bearing.front(), -1.5, 1e-6);
  EXPECT_NEAR(p.bearing.back(), 1.5, 1e-6);
}

TEST(Convert, StartsBehindAWideGapInside) {
  std::vector<float> bearings;
  for (int i = 0; i < 360; ++i) {
    if (i < 100 || i > 300) bearings.push_back(static_cast<float>(i) * 0.0174532925F);
  }
  const std::vector<float> ranges(bearings.size(), 2.0F);
  EXPECT_NEAR(converted(bearings, ranges).bearing.front(), 301 * 0.0174532925, 1e-5);
  std::vector<float> backwards(bearings.rbegin(), bearings.rend());
  EXPECT_NEAR(converted(backwards, ranges).bearing.front(), 301 * 0.0174532925, 1e-5);
}

TEST(Convert, DropsTheRepeatedFirstDirection) {
  std::vector<float> bearings;
  for (int i = 0; i <= 360; ++i) bearings.push_back(static_cast<float>(i) * 0.0174532925F);
  EXPECT_EQ(converted(bearings, std::vector<float>(361, 2.0F)).size(), 360U);
}

class Rotated : public testing::TestWithParam<std::size_t> {};

TEST_P(Rotated, GivesTheSamePoints) {
  SimulatedScanner scanner(built_in_world("domestic_room").value(), {}, 7);
  SimulatedScan scan;
  scanner.scan(0.0, 0.0, scan);
  const Points expected = converted(scan.bearings, scan.ranges);
  ASSERT_EQ(expected.size(), 920U);
  const auto shift = static_cast<std::ptrdiff_t>(GetParam());
  std::rotate(scan.bearings.begin(), scan.bearings.begin() + shift, scan.bearings.end());
  std::rotate(scan.ranges.begin(), scan.ranges.begin() + shift, scan.ranges.end());
  EXPECT_EQ(converted(scan.bearings, scan.ranges).bearing, expected.bearing);
  std::reverse(scan.bearings.begin(), scan.bearings.end());
  std::reverse(scan.ranges.begin(), scan.ranges.end());
  const Points clockwise = converted(scan.bearings, scan.ranges);
  EXPECT_EQ(clockwise.bearing, expected.bearing);
  EXPECT_EQ(clockwise.x, expected.x);
  // Dropouts between them change nothing.
  for (std::ptrdiff_t at : {900, 450, 449, 0}) {
    scan.bearings.insert(scan.bearings.begin() + at, 0.5F);
    scan.ranges.insert(scan.ranges.begin() + at, nan_value);
  }
  EXPECT_EQ(converted(scan.bearings, scan.ranges).x, expected.x);
}

INSTANTIATE_TEST_SUITE_P(ByAnyIndex, Rotated, testing::Values(0, 1, 13, 250, 459, 460, 777, 919));

}  // namespace
}  // namespace quoin
