// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/random_worlds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"

namespace quoin {
namespace {

using Eigen::Vector2d;

constexpr double least_clearance = 0.4;  // [m]
constexpr double spacing = 0.35;         // [m] between things that stand apart

double distance_to(const Wall& wall, const Vector2d& point) {
  const Vector2d along = wall.end - wall.start;
  const double share = std::clamp((point - wall.start).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (wall.start + share * along - point).norm();
}

double clearance(const World& world, const Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : world.walls) nearest = std::min(nearest, distance_to(wall, point));
  for (const Pillar& pillar : world.pillars) {
    nearest = std::min(nearest, (pillar.center - point).norm() - pillar.radius);
  }
  return nearest;
}

/// One side of the outer walls, from a corner in the direction `along`, the inside to the left.
/// What interrupts it keeps away from both ends.
class Side {
 public:
  Side(const Vector2d& start, const Vector2d& end)
      : start_(start),
        along_((end - start).normalized()),
        length_((end - start).norm()),
        points_{start} {}

  /// A niche, or with a negative depth a pilaster, of this width somewhere, if there is room.
  void interrupt(Random& random, double width, double depth) {
    const double free = length_ - position_ - width - 2.0 * margin;
    if (free <= 0.0) return;
    position_ += margin + random.uniform(0.0, std::min(free, 3.0));
    const Vector2d outwards(along_.y(), -along_.x());
    add(position_, 0.0, outwards);
    add(position_, depth, outwards);
    position_ += width;
    add(position_, depth, outwards);
    add(position_, 0.0, outwards);
  }

  /// The points from the start on, without the end.
  [[nodiscard]] const std::vector<Vector2d>& points() const { return points_; }

 private:
  static constexpr double margin = 0.5;  // [m]
  void add(double at, double out, const Vector2d& outwards) {
    points_.emplace_back(start_ + at * along_ + out * outwards);
  }

  Vector2d start_, along_;
  double length_;
  std::vector<Vector2d> points_;
  double position_ = 0.0;
};

class Builder {
 public:
  explicit Builder(Random& random) : random_(random) {}

  World room() {
    size(random_.uniform(3.0, 8.0), random_.uniform(3.0, 7.0));
    outer_walls(random_.index(3), 0.4, 1.2, 1);
    const std::size_t doors = 1 + random_.index(2);
    for (std::size_t k = 0; k < doors; ++k) open_door();
    const std::size_t poles = 1 + random_.index(4);
    for (std::size_t k = 0; k < poles; ++k) pillar(0.02, 0.15);
    return place_sensor();
  }

  World flat() {
    size(random_.uniform(8.0, 14.0), random_.uniform(6.0, 10.0));
    outer_walls(random_.index(2), 0.5, 1.2, 1);
    // A wall from side to side, and one or two from it to the outer walls.
    const double across = random_.uniform(0.35, 0.65) * width_;
    const double thickness = random_.uniform() < 0.5 ? 0.0 : random_.uniform(0.08, 0.2);
    const double doorway = partition({across, 0.0}, {across, depth_}, thickness);
    const double half = 0.5 * thickness;
    const double left = beside(doorway);
    partition({0.0, left}, {across - half, left}, thickness);
    if (random_.uniform() < 0.7) {
      const double height = beside(doorway);
      partition({across + half, height}, {width_, height}, thickness);
    }
    if (random_.uniform() < 0.5) open_door();
    pillar(0.02, 0.1);
    return place_sensor();
  }

  World hall() {
    size(random_.uniform(12.0, 30.0), random_.uniform(8.0, 30.0));
    outer_walls(random_.index(2), 1.0, 4.0, 3);
    const std::size_t square = 2 + random_.index(5);
    for (std::size_t k = 0; k < square; ++k) column(0.3, 0.8);
    const std::size_t round = random_.index(4);
    for (std::size_t k = 0; k < round; ++k) pillar(0.15, 0.5);
    return place_sensor();
  }

 private:
  void size(double width, double depth) {
    width_ = width;
    depth_ = depth;
  }

  /// A rectangle of which so many corners are cut off by slanted walls, with up to so many niches
  /// and pilasters a side.
  void outer_walls(std::size_t cut_corners, double shortest_cut, double longest_cut,
                   std::size_t niches) {
    const std::vector<Vector2d> corners{{0.0, 0.0}, {width_, 0.0}, {width_, depth_}, {0.0, depth_}};
    const std::size_t first_cut = random_.index(4);
    std::vector<Vector2d> ends;  // two for each corner that is cut
    for (std::size_t k = 0; k < 4; ++k) {
      const bool cut = (k + 4 - first_cut) % 4 < cut_corners;
      const Vector2d before = (corners[(k + 3) % 4] - corners[k]).normalized();
      const Vector2d after = (corners[(k + 1) % 4] - corners[k]).normalized();
      if (cut) {
        ends.emplace_back(corners[k] + random_.uniform(shortest_cut, longest_cut) * before);
        ends.emplace_back(corners[k] + random_.uniform(shortest_cut, longest_cut) * after);
      } else {
        ends.push_back(corners[k]);
      }
    }
    for (std::size_t k = 0; k < ends.size(); ++k) {
      Side side(ends[k], ends[(k + 1) % ends.size()]);
      const std::size_t count = random_.index(niches + 1);
      for (std::size_t n = 0; n < count; ++n) {
        const double depth = random_.uniform(0.1, 0.5);
        side.interrupt(random_, random_.uniform(0.4, 1.5),
                       random_.uniform() < 0.6 ? depth : -depth);
      }
      const std::vector<Vector2d> points = side.points();
      outline_.insert(outline_.end(), points.begin(), points.end());
    }
    world_.add_polyline(outline_, true);
  }

  /// A wall with a doorway of 0.8 to 1 m, the middle of which is returned [m].
  double partition(const Vector2d& from, const Vector2d& to, double thickness) {
    const double length = (to - from).norm();
    const Vector2d along = (to - from) / length;
    const double door = random_.uniform(0.8, 1.0);
    const double begin = random_.uniform(0.3, length - door - 0.3);
    piece(from, from + begin * along, thickness);
    piece(to, from + (begin + door) * along, thickness);
    return begin + 0.5 * door;
  }

  /// A position [m] for a wall that ends on the wall across, not in its doorway.
  double beside(double doorway) {
    double position = 0.0;
    do {
      position = random_.uniform(0.25, 0.75) * depth_;
    } while (std::abs(position - doorway) < 0.8);
    return position;
  }

  /// From a wall to a free end.
  void piece(const Vector2d& wall, const Vector2d& free, double thickness) {
    if (thickness == 0.0) {
      world_.add_polyline({wall, free}, false);
      return;
    }
    const Vector2d along = (free - wall).normalized();
    const Vector2d aside = 0.5 * thickness * Vector2d(-along.y(), along.x());
    world_.add_polyline({wall + aside, free + aside, free - aside, wall - aside}, false);
  }

  /// A leaf that stands open at an outer wall.
  void open_door() {
    const bool lower = random_.uniform() < 0.5;
    for (int attempt = 0; attempt < 20; ++attempt) {
      const double along = random_.uniform(0.2, 0.8);
      const Vector2d hinge = lower ? Vector2d(along * width_, 0.0) : Vector2d(0.0, along * depth_);
      const double angle = random_.uniform(0.4, pi - 0.4) - (lower ? 0.0 : 0.5 * pi);
      const double length = random_.uniform(0.6, 1.0);
      const Vector2d end = hinge + length * Vector2d(std::cos(angle), std::sin(angle));
      // The wall must be there, and room around the leaf.
      if (clearance(world_, hinge) > 1e-9 || !free(end, 0.0)) continue;
      if (clearance(world_, 0.5 * (hinge + end)) < 0.15) continue;
      world_.add_polyline({hinge, end}, false);
      return;
    }
  }

  [[nodiscard]] bool free(const Vector2d& center, double radius) const {
    const bool in_column = std::ranges::any_of(columns_, [&](const Pillar& column) {
      return (column.center - center).norm() < column.radius + radius;
    });
    return !in_column && inside(center) && clearance(world_, center) > radius + spacing;
  }

  /// Of the outer walls, by their crossings to the right of the point.
  [[nodiscard]] bool inside(const Vector2d& point) const {
    bool inside = false;
    for (std::size_t k = 0; k < outline_.size(); ++k) {
      const Vector2d& a = outline_[k];
      const Vector2d& b = outline_[(k + 1) % outline_.size()];
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      const double share = (point.y() - a.y()) / (b.y() - a.y());
      if (a.x() + share * (b.x() - a.x()) > point.x()) inside = !inside;
    }
    return inside;
  }

  [[nodiscard]] std::optional<Vector2d> find_place(double radius) {
    for (int attempt = 0; attempt < 50; ++attempt) {
      const Vector2d center(random_.uniform(0.0, width_), random_.uniform(0.0, depth_));
      if (free(center, radius)) return center;
    }
    return std::nullopt;
  }

  void pillar(double smallest, double largest) {
    const double radius = random_.uniform(smallest, largest);
    if (const auto center = find_place(radius)) world_.pillars.push_back({*center, radius});
  }

  void column(double smallest, double largest) {
    const double half = 0.5 * random_.uniform(smallest, largest);
    const auto center = find_place(std::sqrt(2.0) * half);
    if (!center) return;
    columns_.push_back({*center, std::sqrt(2.0) * half});
    const double direction = random_.uniform() < 0.5 ? 0.0 : random_.uniform(0.0, 0.5 * pi);
    const Vector2d u = half * Vector2d(std::cos(direction), std::sin(direction));
    const Vector2d v(-u.y(), u.x());
    world_.add_polyline({*center + u + v, *center - u + v, *center - u - v, *center + u - v}, true);
  }

  World place_sensor() {
    Vector2d place = Vector2d::Zero();
    do {
      place = {random_.uniform(0.0, width_), random_.uniform(0.0, depth_)};
    } while (!free(place, least_clearance - spacing));
    world_.path = {{place.x(), place.y(), random_.uniform(-pi, pi)}};
    return std::move(world_);
  }

  Random& random_;
  double width_ = 0.0;  // [m] x
  double depth_ = 0.0;  // [m] y
  World world_;
  std::vector<Vector2d> outline_;  // of the outer walls, counter-clockwise
  std::vector<Pillar> columns_;    // circles around the square ones
};

World build(WorldStyle style, Random& random) {
  switch (style) {
    case WorldStyle::room:
      return Builder(random).room();
    case WorldStyle::flat:
      return Builder(random).flat();
    case WorldStyle::hall:
      return Builder(random).hall();
  }
  return {};
}

}  // namespace

std::vector<World> random_worlds(WorldStyle style, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<World> worlds;
  for (std::size_t i = 0; i < count; ++i) {
    worlds.push_back(build(style, random));
    worlds.back().name = std::string(enum_name(style)) + "_" + std::to_string(i);
    worlds.back().description = std::string(enum_name(style)) + " at random";
  }
  return worlds;
}

}  // namespace quoin
