// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/world.hpp"

#include <cmath>
#include <cstddef>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr double same_point = 1e-9;  // [m]

Pose2 interpolate(const Pose2& from, const Pose2& to, double fraction) {
  const double turn = normalized_angle(to.theta - from.theta);
  return {from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y),
          normalized_angle(from.theta + fraction * turn)};
}

double distance_between(const Pose2& a, const Pose2& b) { return std::hypot(b.x - a.x, b.y - a.y); }

}  // namespace

void World::add_polyline(const std::vector<Eigen::Vector2d>& points, bool closed) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) walls.push_back({points[i], points[i + 1]});
  if (closed && points.size() > 2) walls.push_back({points.back(), points.front()});
}

std::vector<Eigen::Vector2d> World::corners() const {
  struct End {
    Eigen::Vector2d point;
    Eigen::Vector2d direction;
  };
  std::vector<End> ends;
  for (const Wall& wall : walls) {
    const Eigen::Vector2d direction = (wall.end - wall.start).normalized();
    ends.push_back({wall.start, direction});
    ends.push_back({wall.end, direction});
  }
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    std::size_t meeting = 0;
    std::size_t other = i;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (k == i || (ends[k].point - ends[i].point).norm() > same_point) continue;
      ++meeting;
      other = k;
    }
    if (meeting != 1 || other < i) continue;
    const Eigen::Vector2d& a = ends[i].direction;
    const Eigen::Vector2d& b = ends[other].direction;
    if (std::abs(a.x() * b.y() - a.y() * b.x()) > 1e-6) corners.push_back(ends[i].point);
  }
  return corners;
}

Pose2 World::pose_at(double distance) const {
  if (path.empty()) return {};
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    length += distance_between(path[i], path[i + 1]);
  if (!(length > 0.0) || !std::isfinite(distance)) return path.front();

  double along = std::fmod(distance, 2.0 * length);
  if (along < 0.0) along += 2.0 * length;
  if (along > length) along = 2.0 * length - along;  // on the way back
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double step = distance_between(path[i], path[i + 1]);
    if (along <= step && step > 0.0) return interpolate(path[i], path[i + 1], along / step);
    along -= step;
  }
  return path.back();
}

}  // namespace quoin
