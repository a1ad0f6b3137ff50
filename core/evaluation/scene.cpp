// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/scene.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {

Line wall_line(const Wall& wall, const Pose2& pose) {
  const Eigen::Vector2d start = pose.inverse_transform(wall.start);
  const Eigen::Vector2d along = (pose.inverse_transform(wall.end) - start).normalized();
  const Eigen::Vector2d normal(-along.y(), along.x());
  return normalized({{std::atan2(normal.y(), normal.x()), normal.dot(start)}, {}}).line;
}

Scene observe(const World& world, const Pose2& pose, std::size_t rays, std::size_t min_points) {
  const double step = 2.0 * pi / static_cast<double>(rays);
  std::vector<Hit> hits(rays);
  std::vector<double> bearings(rays);
  for (std::size_t i = 0; i < rays; ++i) {
    bearings[i] = -pi + (static_cast<double>(i) + 0.5) * step;
    const double heading = pose.theta + bearings[i];
    hits[i] = cast_ray(world, {pose.x, pose.y}, {std::cos(heading), std::sin(heading)});
  }

  Scene scene;
  const auto same_run = [&](std::size_t i, std::size_t k) { return hits[i].wall == hits[k].wall; };
  std::size_t first = 0;  // where a run begins, so that none is cut by the seam
  while (first < rays && same_run(first, (first + rays - 1) % rays)) ++first;
  if (first == rays) return scene;
  for (std::size_t done = 0; done < rays;) {
    const std::size_t begin = (first + done) % rays;
    std::size_t count = 1;
    while (done + count < rays && same_run(begin, (begin + count) % rays)) ++count;
    done += count;
    if (hits[begin].wall == Hit::no_wall || count < min_points) continue;
    VisibleWall wall;
    wall.wall = hits[begin].wall;
    wall.line = wall_line(world.walls[wall.wall], pose);
    for (std::size_t k = 0; k < count; ++k) {
      wall.bearings.push_back(bearings[(begin + k) % rays]);
      wall.ranges.push_back(hits[(begin + k) % rays].distance);
    }
    scene.walls.push_back(std::move(wall));
  }

  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const std::size_t next = (i + 1) % scene.walls.size();
    // Between walls that meet in sight there is no other ray; a spacing of 1.5 steps decides.
    const double gap =
        normalized_angle(scene.walls[next].bearings.front() - scene.walls[i].bearings.back());
    if (next == i || !(std::abs(gap) < 1.5 * step)) continue;
    const auto corner =
        meeting_point(world.walls[scene.walls[i].wall], world.walls[scene.walls[next].wall]);
    if (!corner) continue;
    // Two walls that meet behind something else do not meet where they are seen.
    const Eigen::Vector2d position = pose.inverse_transform(*corner);
    const double bearing = std::atan2(position.y(), position.x());
    const double off = normalized_angle(bearing - scene.walls[i].bearings.back());
    if (std::abs(off) < 1.5 * step) scene.corners.push_back({position, i, next});
  }
  return scene;
}

void measure(const VisibleWall& wall, const SensorModel& noise, Random& random, Points& points) {
  const std::size_t count = wall.bearings.size();
  points.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    points.range[i] =
        wall.ranges[i] + std::sqrt(noise.range_variance(wall.ranges[i])) * random.normal();
    points.bearing[i] = wall.bearings[i] + noise.bearing_stddev * random.normal();
  }
  compute_cartesian(points);
}

}  // namespace quoin
