// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/world.hpp"

namespace quoin {
namespace {

/// Square with its corners on the axes, so that one corner points at a sensor that looks along an
/// axis.
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

using Eigen::Vector2d;

constexpr double wall_clearance = 0.05;   // [m] of what does not stand against a wall
constexpr double sensor_clearance = 0.5;  // [m]

/// Fills a room; what is placed is kept apart by enclosing circles.
class Furnisher {
 public:
  explicit Furnisher(Random& random) : random_(random) {
    width_ = random_.uniform(4.0, 9.0);
    depth_ = random_.uniform(3.5, 7.0);
  }

  World furnish() {
    add_walls();
    const Vector2d sensor(random_.uniform(0.25, 0.75) * width_,
                          random_.uniform(0.25, 0.75) * depth_);
    world_.path = {{sensor.x(), sensor.y(), random_.uniform(-pi, pi)}};
    taken_.push_back({sensor, sensor_clearance});

    repeat(2, 4, [this] { add_cabinet(); });
    repeat(1, 3, [this] { add_crate(); });
    repeat(1, 2, [this] { add_table(); });
    repeat(1, 3, [this] { add_bin(); });
    repeat(0, 2, [this] { add_person(); });
    repeat(1, 3, [this] { add_heap(); });
    return std::move(world_);
  }

 private:
  struct Circle {
    Vector2d center;
    double radius;
  };

  template <class Action>
  void repeat(std::size_t fewest, std::size_t most, const Action& action) {
    const std::size_t count = fewest + random_.index(most - fewest + 1);
    for (std::size_t i = 0; i < count; ++i) action();
  }

  /// Occupies the circle when it is free.
  bool take(const Vector2d& center, double radius) {
    const bool free = std::none_of(taken_.begin(), taken_.end(), [&](const Circle& other) {
      return (other.center - center).norm() < other.radius + radius;
    });
    if (free) taken_.push_back({center, radius});
    return free;
  }

  /// A free position for an object of this radius, or nothing after some attempts.
  bool find_place(double radius, Vector2d& center) {
    const double margin = radius + wall_clearance;
    for (int attempt = 0; attempt < 20; ++attempt) {
      center = {random_.uniform(margin, width_ - margin), random_.uniform(margin, depth_ - margin)};
      if (take(center, radius)) return true;
    }
    return false;
  }

  void add_rectangle(const Vector2d& center, double length, double breadth, double direction) {
    const Vector2d u = 0.5 * length * Vector2d(std::cos(direction), std::sin(direction));
    const Vector2d v = 0.5 * breadth * Vector2d(-std::sin(direction), std::cos(direction));
    world_.add_polyline({center + u + v, center - u + v, center - u - v, center + u - v}, true);
  }

  void add_walls() {
    // A door niche in the lower wall, a chimney at the right one.
    const double door = random_.uniform(0.15, 0.6) * width_;
    const double chimney = random_.uniform(0.2, 0.6) * depth_;
    const double niche = random_.uniform(0.15, 0.35);
    const double depth = random_.uniform(0.2, 0.4);
    world_.add_polyline({{0.0, 0.0},
                         {door, 0.0},
                         {door, -niche},
                         {door + 0.9, -niche},
                         {door + 0.9, 0.0},
                         {width_, 0.0},
                         {width_, chimney},
                         {width_ - depth, chimney},
                         {width_ - depth, chimney + 0.6},
                         {width_, chimney + 0.6},
                         {width_, depth_},
                         {0.0, depth_}},
                        true);
    taken_.push_back({{width_, chimney + 0.3}, 0.6});
  }

  /// Against the left or the upper wall.
  void add_cabinet() {
    const double length = random_.uniform(0.6, 2.0);
    const double breadth = random_.uniform(0.3, 0.7);
    const bool left = random_.uniform() < 0.5;
    const double room = (left ? depth_ : width_) - length;
    const double along = random_.uniform(0.0, room) + 0.5 * length;
    const Vector2d center =
        left ? Vector2d(0.5 * breadth, along) : Vector2d(along, depth_ - 0.5 * breadth);
    if (!take(center, 0.5 * std::hypot(length, breadth))) return;
    add_rectangle(center, length, breadth, left ? 0.5 * pi : 0.0);
  }

  /// Free in the room, turned.
  void add_crate() {
    const double length = random_.uniform(0.4, 1.2);
    const double breadth = random_.uniform(0.4, 0.8);
    Vector2d center;
    if (!find_place(0.5 * std::hypot(length, breadth), center)) return;
    add_rectangle(center, length, breadth, random_.uniform(0.0, pi));
  }

  /// Four legs.
  void add_table() {
    const double length = random_.uniform(0.8, 1.6);
    const double breadth = random_.uniform(0.6, 0.9);
    const double direction = random_.uniform(0.0, pi);
    Vector2d center;
    if (!find_place(0.5 * std::hypot(length, breadth), center)) return;
    const Vector2d u = 0.5 * length * Vector2d(std::cos(direction), std::sin(direction));
    const Vector2d v = 0.5 * breadth * Vector2d(-std::sin(direction), std::cos(direction));
    for (const Vector2d& leg :
         {Vector2d(u + v), Vector2d(u - v), Vector2d(-u + v), Vector2d(-u - v)})
      world_.pillars.push_back({center + leg, 0.025});
  }

  void add_bin() {
    const double radius = random_.uniform(0.12, 0.25);
    Vector2d center;
    if (find_place(radius, center)) world_.pillars.push_back({center, radius});
  }

  /// Two legs.
  void add_person() {
    Vector2d center;
    if (!find_place(0.25, center)) return;
    const double direction = random_.uniform(0.0, 2.0 * pi);
    const Vector2d step = 0.13 * Vector2d(std::cos(direction), std::sin(direction));
    world_.pillars.push_back({center + step, 0.06});
    world_.pillars.push_back({center - step, 0.06});
  }

  /// A contour of short edges without a straight run: bags, plants, cables.
  void add_heap() {
    const double radius = random_.uniform(0.2, 0.4);
    Vector2d center;
    if (!find_place(radius, center)) return;
    const std::size_t edges = 9 + random_.index(8);
    std::vector<Vector2d> contour;
    for (std::size_t i = 0; i < edges; ++i) {
      const double direction = 2.0 * pi * static_cast<double>(i) / static_cast<double>(edges);
      const double reach = radius * random_.uniform(0.45, 1.0);
      contour.push_back(center + reach * Vector2d(std::cos(direction), std::sin(direction)));
    }
    world_.add_polyline(contour, true);
  }

  Random& random_;
  double width_ = 0.0;  // [m] x
  double depth_ = 0.0;  // [m] y
  World world_;
  std::vector<Circle> taken_;
};

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

std::vector<World> cluttered_rooms(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<World> rooms;
  for (std::size_t i = 0; i < count; ++i) {
    rooms.push_back(Furnisher(random).furnish());
    rooms.back().name = "cluttered_room_" + std::to_string(i);
    rooms.back().description = "room with furniture and clutter at random";
  }
  return rooms;
}

}  // namespace quoin
