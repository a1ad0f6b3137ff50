// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "core/simulation/world.hpp"

namespace quoin {
namespace {

/// Square with its corners on the axes, so that one corner points at who looks along an axis.
std::vector<Eigen::Vector2d> diamond(double x, double y, double half_diagonal) {
  return {{x + half_diagonal, y},
          {x, y + half_diagonal},
          {x - half_diagonal, y},
          {x, y - half_diagonal}};
}

World domestic_room() {
  World world;
  world.name = "domestic_room";
  world.description = "furnished room of 5 x 4 m: sofa, wardrobe, column, table legs, door niche";
  world.add_polyline({{0.0, 0.75},
                      {2.0, 0.75},
                      {2.0, 0.0},  // sofa
                      {3.2, 0.0},
                      {3.2, -0.25},
                      {4.2, -0.25},
                      {4.2, 0.0},  // door
                      {5.0, 0.0},  //
                      {5.0, 2.2},
                      {4.65, 2.2},
                      {4.65, 2.55},
                      {5.0, 2.55},  // chimney
                      {5.0, 4.0},   //
                      {1.6, 4.0},
                      {1.6, 3.4},
                      {0.0, 3.4}},  // wardrobe
                     true);
  world.add_polyline({{3.0, 3.2}, {3.0, 2.9}, {3.3, 2.9}, {3.3, 3.2}}, true);  // column
  for (const Eigen::Vector2d& leg : {Eigen::Vector2d{0.7, 1.6}, Eigen::Vector2d{1.3, 1.6},
                                     Eigen::Vector2d{0.7, 2.4}, Eigen::Vector2d{1.3, 2.4}}) {
    world.pillars.push_back({leg, 0.025});
  }
  world.path = {
      {2.5, 1.5, 0.3}, {3.4, 1.2, 0.0}, {4.0, 1.7, 1.6}, {2.6, 2.2, 2.8}, {2.1, 1.7, -1.6}};
  return world;
}

World environment_a() {
  World world;
  world.name = "environment_a";
  world.description =
      "room of 4.5 x 2.5 m with niches, a column and a wardrobe: 21 walls and 18 corners in sight";
  world.add_polyline({{0.0, 0.0}, {1.05, 0.0}, {1.05, -0.3}, {1.95, -0.3}, {1.95, 0.0},  // niche
                      {2.7, 0.0}, {2.7, -0.5}, {3.6, -0.5},  {3.6, 0.0},                 // door
                      {4.5, 0.0}, {4.5, 0.4},  {5.1, 0.4},   {5.1, 1.7},   {4.5, 1.7},   // window
                      {4.5, 2.5}, {3.55, 2.5}, {3.55, 3.1},  {2.8, 3.1},   {2.8, 2.5},   // wardrobe
                      {2.4, 2.5}, {2.4, 2.05}, {1.45, 2.05}, {1.45, 2.5},                // column
                      {0.0, 2.5}},
                     true);
  world.path = {{2.9, 0.95, 0.0}, {2.6, 1.1, 0.4}, {1.4, 1.3, 2.9}};
  return world;
}

World environment_b() {
  World world;
  world.name = "environment_b";
  world.description =
      "laboratory of 18 x 9 m with cabinets, columns and a panel: 36 walls and 23 corners in sight";
  world.add_polyline({{1.2, 0.0},                                           // corner cupboard
                      {3.2, 0.0},  {3.2, 0.8},   {4.6, 0.8},  {4.6, 0.0},   // cabinet
                      {10.0, 0.0}, {10.0, 0.7},  {11.2, 0.7}, {11.2, 0.0},  // cabinet
                      {14.0, 0.0}, {14.0, 0.6},  {15.0, 0.6}, {15.0, 0.0},  // cabinet
                      {18.0, 0.0}, {18.0, 9.0},                             //
                      {14.0, 9.0}, {14.0, 8.1},  {12.5, 8.1}, {12.5, 9.0},  // cabinet
                      {10.5, 9.0}, {10.5, 10.0}, {5.5, 10.0}, {5.5, 9.0},   // bay
                      {3.6, 9.0},  {3.6, 8.1},   {2.6, 8.1},  {2.6, 9.0},   // cabinet
                      {0.0, 9.0},                                           //
                      {0.0, 1.0},  {1.2, 1.0}},                             // corner cupboard
                     true);
  world.add_polyline(diamond(3.5, 4.3, 0.5), true);
  world.add_polyline(diamond(13.5, 4.4, 0.55), true);
  world.add_polyline(diamond(7.4, 1.8, 0.4), true);
  world.add_polyline({{4.6, 5.1}, {4.6, 5.7}}, false);
  world.path = {{8.0, 4.0, 0.0}, {11.0, 3.5, -0.3}, {11.5, 6.0, 1.6}, {7.0, 6.5, 3.0}};
  return world;
}

World cwlf_environment_a() {
  World world;
  world.name = "cwlf_environment_a";
  world.description =
      "room of 9 x 8 m with bays, a pilaster and panels: 36 walls and 23 corners in sight";
  world.add_polyline({{1.0, 0.0},  {3.2, 0.0},  {3.6, -0.5}, {5.4, -0.5}, {5.8, 0.0},  // bay
                      {9.0, 0.0},  {9.0, 2.6},  {8.5, 3.1},  {8.5, 4.6},  {9.0, 5.1},  // pilaster
                      {9.0, 6.74}, {7.5, 8.0},                            // slanted wall
                      {5.6, 8.0},  {5.2, 8.5},  {3.9, 8.5},  {3.5, 8.0},  // bay
                      {1.6, 8.0},  {0.0, 6.6},                            // slanted wall
                      {0.0, 5.2},  {-0.5, 4.8}, {-0.5, 3.4}, {0.0, 3.0},  // bay
                      {0.0, 1.0}},                                        // slanted wall
                     true);
  // Panels that hide parts of the walls behind them.
  world.add_polyline({{6.58, 2.59}, {6.76, 2.91}}, false);
  world.add_polyline({{5.71, 1.81}, {6.01, 2.00}}, false);
  world.add_polyline({{3.09, 1.92}, {3.41, 1.74}}, false);
  world.add_polyline({{2.13, 3.19}, {2.27, 2.86}}, false);
  world.add_polyline({{6.48, 5.54}, {6.24, 5.81}}, false);
  world.add_polyline({{5.76, 6.17}, {5.43, 6.33}}, false);
  world.pillars.push_back({{3.44, 6.27}, 0.05});
  world.path = {{4.5, 4.0, 0.0}, {5.2, 3.6, 0.3}, {3.8, 4.4, 2.9}};
  return world;
}

World cwlf_environment_b() {
  World world;
  world.name = "cwlf_environment_b";
  world.description = "room of 3.5 x 6 m with bays and a panel: 18 walls and 15 corners in sight";
  world.add_polyline({{0.6, 0.0},
                      {3.5, 0.0},
                      {3.5, 1.9},
                      {3.2, 2.3},  // step
                      {3.2, 6.0},
                      {2.4, 6.0},
                      {2.2, 6.3},
                      {1.2, 6.3},
                      {1.0, 6.0},  // bay
                      {0.0, 6.0},
                      {0.0, 4.1},
                      {-0.3, 3.8},
                      {-0.3, 2.6},
                      {0.0, 2.3},   // bay
                      {0.0, 0.6}},  // slanted wall
                     true);
  world.add_polyline({{1.85, 1.6}, {2.15, 1.6}}, false);
  world.pillars.push_back({{0.86, 3.95}, 0.04});
  world.path = {{1.75, 3.0, 0.0}, {1.8, 2.2, 0.4}, {1.7, 4.2, 2.9}};
  return world;
}

World corridor() {
  World world;
  world.name = "corridor";
  world.description = "corridor of 14 x 1.8 m with door niches on both sides";
  world.add_polyline(
      {{0.0, 0.0},  {3.0, 0.0}, {3.0, -0.3}, {4.0, -0.3}, {4.0, 0.0},  {8.0, 0.0},  {8.0, -0.3},
       {9.0, -0.3}, {9.0, 0.0}, {14.0, 0.0}, {14.0, 1.8}, {11.0, 1.8}, {11.0, 2.1}, {10.0, 2.1},
       {10.0, 1.8}, {6.0, 1.8}, {6.0, 2.1},  {5.0, 2.1},  {5.0, 1.8},  {0.0, 1.8}},
      true);
  world.path = {{1.5, 0.8, 0.0}, {7.0, 1.0, 0.0}, {12.5, 0.8, 0.0}};
  return world;
}

World square_room() {
  World world;
  world.name = "square_room";
  world.description = "empty room of 4 x 4 m";
  world.add_polyline({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}, true);
  world.path = {{2.0, 2.0, 0.0}, {2.8, 1.4, 0.7}, {1.3, 1.2, 2.5}, {1.5, 2.9, -2.0}};
  return world;
}

struct Entry {
  std::string_view name;
  World (*make)();
};

constexpr std::array<Entry, 7> entries{{{"domestic_room", domestic_room},
                                        {"environment_a", environment_a},
                                        {"environment_b", environment_b},
                                        {"cwlf_environment_a", cwlf_environment_a},
                                        {"cwlf_environment_b", cwlf_environment_b},
                                        {"corridor", corridor},
                                        {"square_room", square_room}}};

}  // namespace

std::vector<std::string> world_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  return names;
}

std::optional<World> built_in_world(std::string_view name) {
  for (const Entry& entry : entries) {
    if (entry.name == name) return entry.make();
  }
  return std::nullopt;
}

}  // namespace quoin
