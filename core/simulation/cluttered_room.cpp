// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/cluttered_room.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"

namespace quoin {
namespace {

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

  /// Takes the place when it is free.
  bool take(const Vector2d& center, double radius) {
    const bool free = std::none_of(taken_.begin(), taken_.end(), [&](const Circle& other) {
      return (other.center - center).norm() < other.radius + radius;
    });
    if (free) taken_.push_back({center, radius});
    return free;
  }

  /// A free place for something of this radius, or nothing after some attempts.
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
