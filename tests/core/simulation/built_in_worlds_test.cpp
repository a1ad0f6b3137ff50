// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"

namespace quoin {
namespace {

TEST(ClutteredRooms, RepeatThemselvesWhateverTheCount) {
  const std::vector<World> three = cluttered_rooms(3, 9);
  const std::vector<World> five = cluttered_rooms(5, 9);
  for (std::size_t i = 0; i < three.size(); ++i) {
    ASSERT_EQ(three[i].walls.size(), five[i].walls.size());
    EXPECT_EQ(three[i].walls.back().end, five[i].walls.back().end);
    EXPECT_EQ(three[i].name, five[i].name);
  }
  EXPECT_NE(cluttered_rooms(1, 10).front().walls[4].end, three.front().walls[4].end);
}

TEST(ClutteredRooms, AreClosedAndLeaveTheSensorFree) {
  double pillars = 0.0;
  for (const World& room : cluttered_rooms(50, 1)) {
    const Pose2& pose = room.path.front();
    for (int k = 0; k < 720; ++k) {
      const double heading = k * pi / 360.0;
      const Hit hit = cast_ray(room, {pose.x, pose.y}, {std::cos(heading), std::sin(heading)});
      // Half a metre around the sensor, less what table corners reach over their circle.
      ASSERT_GT(hit.distance, 0.45) << room.name;
      ASSERT_LT(hit.distance, 15.0) << room.name;
    }
    EXPECT_GT(room.walls.size(), 12U);
    pillars += static_cast<double>(room.pillars.size());
  }
  EXPECT_GT(pillars / 50.0, 3.0);
}

}  // namespace
}  // namespace quoin
