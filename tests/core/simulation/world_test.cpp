// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/world.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/geometry/angle.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {
namespace {

TEST(World, KnowsItsCorners) {
  World world;
  world.add_polyline({{0, 0}, {2, 0}, {3, 0}, {3, 1}}, false);
  const auto corners = world.corners();
  ASSERT_EQ(corners.size(), 1U);  // (2, 0) is no corner, free ends are none
  EXPECT_EQ(corners[0], Eigen::Vector2d(3, 0));
}

TEST(World, KnowsWherePartitionsEndOnWallsAndWhereWallsCross) {
  World world;
  world.add_polyline({{0, 0}, {4, 0}}, false);
  world.add_polyline({{1, 0}, {1, 2}}, false);       // ends on the wall
  world.add_polyline({{2, 0.0004}, {2, 2}}, false);  // ends on it as written to 1 mm
  world.add_polyline({{3, 0.01}, {3, 2}}, false);    // ends before it
  world.add_polyline({{0, 1}, {1.5, 1}}, false);     // crosses the first partition
  world.add_polyline({{4, 0}, {4, 1}}, false);       // three walls end at (4, 0)
  world.add_polyline({{4, 0}, {5, -1}}, false);
  EXPECT_THAT(world.corners(),
              testing::UnorderedElementsAre(Eigen::Vector2d(1, 0), Eigen::Vector2d(2, 0),
                                            Eigen::Vector2d(1, 1), Eigen::Vector2d(4, 0)));
}

TEST(MeetingPoint, NeedsBothWalls) {
  const Wall wall{{0, 0}, {2, 0}};
  EXPECT_EQ(meeting_point(wall, {{1, -1}, {1, 1}}), Eigen::Vector2d(1, 0));
  EXPECT_EQ(meeting_point(wall, {{2, 0}, {3, 4}}), Eigen::Vector2d(2, 0));
  EXPECT_FALSE(meeting_point(wall, {{3, -1}, {3, 1}}));
  EXPECT_FALSE(meeting_point(wall, {{1, 1}, {1, 2}}));
  EXPECT_FALSE(meeting_point(wall, {{2, 0}, {3, 0}}));  // one goes on as the other
  EXPECT_FALSE(meeting_point(wall, {{1, 0}, {1, 0}}));  // no length
}

TEST(World, TravelsThereAndBack) {
  World world;
  EXPECT_EQ(world.pose_at(1.0).x, 0.0);
  world.path = {{0, 0, 3.0}, {2, 0, -3.0}, {2, 1, 0.0}};
  EXPECT_DOUBLE_EQ(world.pose_at(1.0).x, 1.0);
  EXPECT_NEAR(std::abs(world.pose_at(1.0).theta), pi, 1e-12);  // the short way round
  EXPECT_DOUBLE_EQ(world.pose_at(2.5).y, 0.5);
  EXPECT_NEAR(world.pose_at(3.5).y, 0.5, 1e-12);
  EXPECT_NEAR(world.pose_at(6.0).x, 0.0, 1e-12);
  EXPECT_NEAR(world.pose_at(-1.0).x, 1.0, 1e-12);
  EXPECT_NEAR(world.pose_at(7.0).x, 1.0, 1e-12);
  world.path.resize(1);
  EXPECT_DOUBLE_EQ(world.pose_at(5.0).theta, 3.0);
}

TEST(BuiltInWorlds, AreClosedAroundTheirPath) {
  ASSERT_THAT(world_names(), testing::ElementsAre("domestic_room", "environment_a", "environment_b",
                                                  "cwlf_environment_a", "cwlf_environment_b",
                                                  "corridor", "square_room"));
  EXPECT_FALSE(built_in_world("nowhere"));
  for (const std::string& name : world_names()) {
    const World world = built_in_world(name).value();
    EXPECT_EQ(world.name, name);
    EXPECT_GE(world.corners().size(), 4U);
    for (double distance = 0.0; distance < 12.0; distance += 0.1) {
      const Pose2 pose = world.pose_at(distance);
      for (int k = 0; k < 360; ++k) {
        const double bearing = k * pi / 180.0;
        const double range =
            cast_ray(world, {pose.x, pose.y}, {std::cos(bearing), std::sin(bearing)}).distance;
        ASSERT_GT(range, 0.15) << name << " " << distance;
        ASSERT_LT(range, 20.0) << name << " " << distance;
      }
    }
  }
}

TEST(BuiltInWorlds, ShowAllCornersOfTheSquareRoom) {
  const World world = built_in_world("square_room").value();
  for (const Eigen::Vector2d& corner : world.corners()) {
    const Eigen::Vector2d origin(world.path[0].x, world.path[0].y);
    const Eigen::Vector2d ray = corner - origin;
    EXPECT_NEAR(cast_ray(world, origin, ray.normalized()).distance, ray.norm(), 1e-9);
  }
}

}  // namespace
}  // namespace quoin
