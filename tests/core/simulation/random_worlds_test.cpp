// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/random_worlds.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/evaluation/corner_quality.hpp"
#include "core/geometry/angle.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {
namespace {

class RandomWorlds : public testing::TestWithParam<WorldStyle> {};

TEST_P(RandomWorlds, RepeatThemselvesWhateverTheCount) {
  const auto few = random_worlds(GetParam(), 3, 9);
  const auto many = random_worlds(GetParam(), 6, 9);
  for (std::size_t k = 0; k < few.size(); ++k) {
    ASSERT_EQ(few[k].walls.size(), many[k].walls.size());
    EXPECT_EQ(few[k].walls.back().end, many[k].walls.back().end);
    EXPECT_EQ(few[k].path.front().theta, many[k].path.front().theta);
  }
  EXPECT_NE(random_worlds(GetParam(), 1, 10)[0].path.front().x, few[0].path.front().x);
}

TEST_P(RandomWorlds, AreClosedLeaveTheSensorFreeAndShowCorners) {
  for (const World& world : random_worlds(GetParam(), 100, 3)) {
    const Pose2 pose = world.path.front();
    const double largest = GetParam() == WorldStyle::hall ? 45.0 : 20.0;
    for (int k = 0; k < 720; ++k) {
      const double bearing = k * pi / 360.0;
      const double range =
          cast_ray(world, {pose.x, pose.y}, {std::cos(bearing), std::sin(bearing)}).distance;
      ASSERT_GT(range, 0.39) << world.name;
      ASSERT_LT(range, largest) << world.name;
    }
    EXPECT_GE(world.corners().size(), 4U) << world.name;
  }
}

TEST_P(RandomWorlds, MostlyHaveCornersToBeFound) {
  std::size_t corners = 0;
  for (const World& world : random_worlds(GetParam(), 40, 3)) {
    const CornerTruth truth = corner_truth(world, world.path.front(), 920);
    corners += static_cast<std::size_t>(std::ranges::count(truth.to_be_found, true));
  }
  EXPECT_GT(corners, 40U * 2U);
}

INSTANTIATE_TEST_SUITE_P(All, RandomWorlds,
                         testing::Values(WorldStyle::room, WorldStyle::flat, WorldStyle::hall),
                         [](const auto& style) { return std::string(enum_name(style.param)); });

}  // namespace
}  // namespace quoin
