// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/line_map.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/simulation/random.hpp"

namespace quoin {
namespace {

using Point = Eigen::Vector2d;
constexpr double degree = 3.14159265358979323846 / 180.0;

LineMap map_of_the_paper() { return {15.0 * degree, 1.0}; }

TEST(LineMap, LengthensAWallToTheProjectionsOfNewEnds) {
  LineMap map = map_of_the_paper();
  map.add({0.0, 2.0}, {2.0, 2.0});
  map.merge({0.5, 2.1}, {2.6, 2.2});
  ASSERT_EQ(map.lines().size(), 1U);
  EXPECT_NEAR((map.lines()[0].start - Point(0.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((map.lines()[0].end - Point(2.6, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(map.lines()[0].observations, 2U);
}

TEST(LineMap, ReadsTheSenseOfANewSegmentEitherWay) {
  LineMap map = map_of_the_paper();
  map.add({0.0, 2.0}, {2.0, 2.0});
  const auto match = map.find({1.9, 2.0}, {0.1, 2.1});
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->angle_offset, std::atan(0.1 / 1.8), 1e-12);
  map.merge({2.5, 2.0}, {0.0, 2.0});
  EXPECT_NEAR(map.lines()[0].end.x(), 2.5, 1e-12);
}

TEST(LineMap, StoresWhatDiffersInDirectionOrDistance) {
  LineMap map = map_of_the_paper();
  map.add({0.0, 2.0}, {2.0, 2.0});
  // 14 and 16 degrees about the same centroid.
  const Point turn14(std::cos(14 * degree), std::sin(14 * degree));
  const Point turn16(std::cos(16 * degree), std::sin(16 * degree));
  const Point centroid(1.0, 2.0);
  EXPECT_FALSE(map.find(centroid - turn16, centroid + turn16));
  ASSERT_TRUE(map.find(Point(0, 0) + centroid - 0.01 * turn14, centroid + 0.01 * turn14));
  // Parallel: origin distance and centroid distance count both, 0.49 + 0.49 and 0.51 + 0.51.
  EXPECT_TRUE(map.find({0.0, 2.49}, {2.0, 2.49}));
  EXPECT_FALSE(map.find({0.0, 2.51}, {2.0, 2.51}));
  // On either side of the origin: distances are signed.
  LineMap around = map_of_the_paper();
  around.add({-1.0, 0.3}, {1.0, 0.3});
  EXPECT_FALSE(around.find({-1.0, -0.3}, {1.0, -0.3}));
}

TEST(LineMap, TakesTheNearestOfSeveral) {
  LineMap map = map_of_the_paper();
  map.add({0.0, 2.0}, {2.0, 2.0});
  const std::size_t nearer = map.add({0.0, 2.4}, {2.0, 2.4});
  const auto match = map.find({0.0, 2.3}, {2.0, 2.3});
  ASSERT_TRUE(match);
  EXPECT_EQ(match->index, nearer);
  EXPECT_NEAR(match->distance, 0.2, 1e-12);
}

TEST(LineMap, FindsWhatALookAtEveryLineFinds) {
  LineMap map = map_of_the_paper();
  Random random(5);
  const auto segment = [&] {
    const Point middle(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0));
    const double direction = random.uniform(-3.2, 3.2);
    const Point half = random.uniform(0.2, 2.0) * Point(std::cos(direction), std::sin(direction));
    return std::pair<Point, Point>{middle - half, middle + half};
  };
  for (int i = 0; i < 3000; ++i) {
    const auto [start, end] = segment();
    map.merge(start, end);  // centroids move from cell to cell
  }
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [start, end] = segment();
    const auto match = map.find(start, end);
    // One line a map, the nearest of all.
    std::optional<LineMatch> expected;
    for (std::size_t k = 0; k < map.lines().size(); ++k) {
      LineMap one = map_of_the_paper();
      one.add(map.lines()[k].start, map.lines()[k].end);
      const auto single = one.find(start, end);
      if (single && (!expected || single->distance < expected->distance)) {
        expected = single;
        expected->index = k;
      }
    }
    ASSERT_EQ(match.has_value(), expected.has_value());
    if (!match) continue;
    ++found;
    EXPECT_EQ(match->index, expected->index);
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace quoin
