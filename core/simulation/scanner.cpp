// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/scanner.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr double nothing = std::numeric_limits<double>::infinity();

double distance_to(const Wall& wall, const Eigen::Vector2d& origin,
                   const Eigen::Vector2d& direction) {
  constexpr double rim =
      1e-9;  // of the wall's length: rays do not slip through where two walls meet
  const Eigen::Vector2d along = wall.end - wall.start;
  const Eigen::Vector2d to_start = wall.start - origin;
  const double cross = direction.x() * along.y() - direction.y() * along.x();
  if (cross == 0.0) return nothing;
  const double distance = (to_start.x() * along.y() - to_start.y() * along.x()) / cross;
  const double fraction = (to_start.x() * direction.y() - to_start.y() * direction.x()) / cross;
  return distance > 0.0 && fraction >= -rim && fraction <= 1.0 + rim ? distance : nothing;
}

double distance_to(const Pillar& pillar, const Eigen::Vector2d& origin,
                   const Eigen::Vector2d& direction) {
  const Eigen::Vector2d to_center = pillar.center - origin;
  const double along = to_center.dot(direction);
  const double miss_squared = to_center.squaredNorm() - along * along;
  const double half_chord_squared = pillar.radius * pillar.radius - miss_squared;
  if (half_chord_squared < 0.0) return nothing;
  const double half_chord = std::sqrt(half_chord_squared);
  if (along - half_chord > 0.0) return along - half_chord;
  return along + half_chord > 0.0 ? along + half_chord : nothing;  // from inside
}

}  // namespace

Hit cast_ray(const World& world, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction) {
  Hit hit;
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    const double distance = distance_to(world.walls[i], origin, direction);
    if (distance < hit.distance) hit = {distance, i};
  }
  for (const Pillar& pillar : world.pillars) {
    const double distance = distance_to(pillar, origin, direction);
    if (distance < hit.distance) hit = {distance, Hit::no_wall};
  }
  return hit;
}

SimulatedScanner::SimulatedScanner(World world, const ScannerSettings& settings, std::uint64_t seed)
    : world_(std::move(world)), settings_(settings), random_(seed) {}

void SimulatedScanner::scan(double distance, double speed, SimulatedScan& out) {
  const std::size_t count = settings_.points;
  out.bearings.resize(count);
  out.ranges.resize(count);
  out.time_offsets.resize(count);
  out.walls.resize(count);
  if (count == 0) return;

  const double step = settings_.field_of_view / static_cast<double>(count);
  const double time_step = settings_.period * step / (2.0 * pi);
  const double start = settings_.first_bearing + random_.uniform() * step;
  const bool moves = speed != 0.0;
  Pose2 pose = world_.pose_at(distance);
  for (std::size_t i = 0; i < count; ++i) {
    const double bearing = start + static_cast<double>(i) * step;
    const double time = static_cast<double>(i) * time_step;
    if (moves) pose = world_.pose_at(distance + speed * time);
    const double heading = pose.theta + bearing;
    const Hit hit = cast_ray(world_, {pose.x, pose.y}, {std::cos(heading), std::sin(heading)});
    // Every ray takes the same number of random numbers, so that one setting does not shift the
    // rest.
    const bool dropped = random_.uniform() < settings_.dropout;
    const double noise =
        std::isfinite(hit.distance) ? std::sqrt(settings_.noise.range_variance(hit.distance)) : 0.0;
    const double range = hit.distance + settings_.range_bias + noise * random_.normal();
    const double reported_bearing = bearing + settings_.noise.bearing_stddev * random_.normal();

    out.bearings[i] = static_cast<float>(reported_bearing);
    out.time_offsets[i] = static_cast<float>(time);
    out.walls[i] = hit.wall;
    if (dropped || range < settings_.range_min) {
      out.ranges[i] = std::numeric_limits<float>::quiet_NaN();
    } else if (range > settings_.range_max) {
      out.ranges[i] = std::numeric_limits<float>::infinity();
    } else {
      out.ranges[i] = static_cast<float>(range);
    }
  }
}

}  // namespace quoin
