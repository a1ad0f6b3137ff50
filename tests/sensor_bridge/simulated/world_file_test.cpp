// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/world_file.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;

std::string world_error(const std::string& text) {
  return error_of<WorldError>([&] { (void)parse_world(text, "room.yaml"); });
}

TEST(WorldFile, ReadsEverything) {
  const World world = parse_world(R"(name: corridor
description: two walls and a leg
walls:
  - {points: [[0, 0], [20, 0], [20, 2.5]]}
  - points: [[1, 1], [+2, 1], [2, -1e0]]
    closed: true
pillars:
  - {center: [3, 1], radius: 0.1}
path:
  - [1, 1, 0]
  - [19, 1, 3.14]
)",
                                  "room.yaml");
  EXPECT_EQ(world.name, "corridor");
  EXPECT_EQ(world.description, "two walls and a leg");
  ASSERT_EQ(world.walls.size(), 5U);
  EXPECT_EQ(world.walls[1].start, Eigen::Vector2d(20, 0));
  EXPECT_EQ(world.walls[1].end, Eigen::Vector2d(20, 2.5));
  EXPECT_EQ(world.walls[4].start, Eigen::Vector2d(2, -1));
  EXPECT_EQ(world.walls[4].end, Eigen::Vector2d(1, 1));
  ASSERT_EQ(world.pillars.size(), 1U);
  EXPECT_EQ(world.pillars[0].center, Eigen::Vector2d(3, 1));
  EXPECT_EQ(world.pillars[0].radius, 0.1);
  ASSERT_EQ(world.path.size(), 2U);
  EXPECT_EQ(world.path[1].x, 19);
  EXPECT_EQ(world.path[1].theta, 3.14);
}

TEST(WorldFile, IsNamedAfterItsFile) {
  EXPECT_EQ(
      parse_world("walls: [{points: [[0, 0], [1, 0]]}]\npath: [[0, 1, 0]]", "a/room.yaml").name,
      "room");
}

struct BadWorld {
  const char* name;
  const char* text;
  const char* error;
};

class WorldFileError : public ::testing::TestWithParam<BadWorld> {};

TEST_P(WorldFileError, NamesPlaceReasonAndWayOut) {
  EXPECT_EQ(world_error(GetParam().text), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    All, WorldFileError,
    ::testing::Values(
        BadWorld{"empty", "",
                 "room.yaml:1:1: a world is a mapping with the keys name, description, walls, "
                 "pillars, path"},
        BadWorld{"not_a_map", "- 1\n- 2\n",
                 "room.yaml:1:1: a world is a mapping with the keys name, description, walls, "
                 "pillars, path"},
        BadWorld{"unknown_key", "name: a\nwals: []\n",
                 "room.yaml:2:1: unknown key 'wals' in a world; did you mean 'walls'?"},
        BadWorld{"duplicate_key", "name: a\nname: b\n",
                 "room.yaml:2:1: key 'name' is there twice in a world; remove one"},
        BadWorld{"name_is_list", "name: [a]\n", "room.yaml:1:7: 'name' must be a text"},
        BadWorld{"walls_no_list", "walls: 7\n", "room.yaml:1:8: 'walls' must be a list"},
        BadWorld{"wall_no_map", "walls: [7]\n",
                 "room.yaml:1:9: a wall is a mapping with the keys points, closed"},
        BadWorld{"wall_unknown_key", "walls:\n  - {point: [[0, 0], [1, 0]]}\n",
                 "room.yaml:2:6: unknown key 'point' in a wall; did you mean 'points'?"},
        BadWorld{"wall_without_points", "walls:\n  - {closed: true}\n",
                 "room.yaml:2:5: a wall needs the key 'points'"},
        BadWorld{"one_point", "walls:\n  - {points: [[0, 0]]}\n",
                 "room.yaml:2:14: a wall needs at least 2 points"},
        BadWorld{"closed_two_points", "walls:\n  - {points: [[0, 0], [1, 0]], closed: true}\n",
                 "room.yaml:2:14: a closed wall needs at least 3 points"},
        BadWorld{"closed_not_bool", "walls:\n  - {points: [[0, 0], [1, 0]], closed: maybe}\n",
                 "room.yaml:2:40: 'closed' must be true or false"},
        BadWorld{"point_of_three", "walls:\n  - {points: [[0, 0], [1, 0, 2]]}\n",
                 "room.yaml:2:23: a point is written [x, y]"},
        BadWorld{"not_a_number", "walls:\n  - {points: [[0, 0], [1, 0m]]}\n",
                 "room.yaml:2:27: '0m' is not a finite number"},
        BadWorld{"not_finite", "walls:\n  - {points: [[0, 0], [1, nan]]}\n",
                 "room.yaml:2:27: 'nan' is not a finite number"},
        BadWorld{"number_is_list", "walls:\n  - {points: [[0, 0], [1, [2]]]}\n",
                 "room.yaml:2:27: a number is expected here"},
        BadWorld{"repeated_point", "walls:\n  - {points: [[0, 0], [0, 0]]}\n",
                 "room.yaml:2:23: this point repeats the one before it; remove one"},
        BadWorld{"closed_repeats_first",
                 "walls:\n  - {points: [[0, 0], [1, 0], [0, 0]], closed: true}\n",
                 "room.yaml:2:14: a closed wall must not repeat its first point at the end; remove "
                 "the last"},
        BadWorld{"pillar_without_radius", "pillars:\n  - {center: [0, 0]}\n",
                 "room.yaml:2:5: a pillar needs the key 'radius'"},
        BadWorld{"pillar_without_center", "pillars:\n  - {radius: 1}\n",
                 "room.yaml:2:5: a pillar needs the key 'center'"},
        BadWorld{"pillar_radius", "pillars:\n  - {center: [0, 0], radius: -1}\n",
                 "room.yaml:2:30: the radius of a pillar must be positive"},
        BadWorld{"nothing_to_see", "path:\n  - [0, 0, 0]\n",
                 "room.yaml:1:1: the world has neither walls nor pillars; add a 'walls' or a "
                 "'pillars' list"},
        BadWorld{"no_path", "pillars:\n  - {center: [0, 0], radius: 1}\n",
                 "room.yaml:1:1: a world needs the key 'path'"},
        BadWorld{"empty_path", "pillars:\n  - {center: [0, 0], radius: 1}\npath: []\n",
                 "room.yaml:3:7: the path is empty; give at least one [x, y, theta]"},
        BadWorld{"way_point_of_two",
                 "pillars:\n  - {center: [0, 0], radius: 1}\npath:\n  - [1, 2]\n",
                 "room.yaml:4:5: a way point is written [x, y, theta]"},
        BadWorld{"not_yaml", "walls: [\n", "room.yaml:2:1: end of sequence flow not found"}),
    [](const auto& test) { return test.param.name; });

TEST(LoadWorld, FindsBuiltInWorlds) {
  for (const std::string& name : world_names()) EXPECT_EQ(load_world(name, "/nowhere").name, name);
}

TEST(LoadWorld, ReadsAFileRelativeToTheBaseDirectory) {
  const TemporaryFolder folder;
  folder.write("shed.yaml", "walls: [{points: [[0, 0], [1, 0]]}]\npath: [[0, 1, 0]]\n");
  EXPECT_EQ(load_world("shed.yaml", folder.path()).name, "shed");
  EXPECT_EQ(load_world(folder.path() / "shed.yaml", "/nowhere").name, "shed");
}

TEST(LoadWorld, NamesTheFileInErrors) {
  const TemporaryFolder folder;
  const std::string file = folder.write("shed.yaml", "walls: 7\n");
  EXPECT_EQ(error_of<WorldError>([&] { (void)load_world("shed.yaml", folder.path()); }),
            file + ":1:8: 'walls' must be a list");
}

TEST(LoadWorld, ReportsAMissingFile) {
  EXPECT_EQ(error_of<WorldError>([] { (void)load_world("shed.yaml", "/nowhere"); }),
            "cannot read world file '/nowhere/shed.yaml': No such file or directory");
}

TEST(LoadWorld, SuggestsABuiltInWorld) {
  std::string known;
  for (const std::string& name : world_names()) known += (known.empty() ? "" : ", ") + name;
  const std::string rest =
      "(built in are " + known + "; a world of your own is the path of a .yaml file)";
  EXPECT_EQ(error_of<WorldError>([] { (void)load_world("domestic_rom", "/nowhere"); }),
            "unknown environment 'domestic_rom'; did you mean 'domestic_room'? " + rest);
  EXPECT_EQ(error_of<WorldError>([] { (void)load_world("zzzzzzzzzzzzz", "/nowhere"); }),
            "unknown environment 'zzzzzzzzzzzzz'; " + rest);
}

}  // namespace
}  // namespace quoin::sensor_bridge
