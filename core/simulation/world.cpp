// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr double same_vertex = 1e-3;    // [m] as exactly as files of worlds are written
constexpr double exact = 1e-9;          // [m]
constexpr double smallest_sine = 1e-6;  // of the angle between walls that are not parallel

Pose2 pose_between(const Pose2& from, const Pose2& to, double fraction) {
  const double turn = normalized_angle(to.theta - from.theta);
  return {from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y),
          normalized_angle(from.theta + fraction * turn)};
}

double distance_between(const Pose2& a, const Pose2& b) { return std::hypot(b.x - a.x, b.y - a.y); }

}  // namespace

std::optional<Eigen::Vector2d> meeting_point(const Wall& first, const Wall& second) {
  const double first_length = (first.end - first.start).norm();
  const double second_length = (second.end - second.start).norm();
  if (!(first_length > 0.0 && second_length > 0.0)) return std::nullopt;
  const Eigen::Vector2d a = (first.end - first.start) / first_length;
  const Eigen::Vector2d b = (second.end - second.start) / second_length;
  const double sine = a.x() * b.y() - a.y() * b.x();
  if (!(std::abs(sine) > smallest_sine)) return std::nullopt;
  const Eigen::Vector2d apart = second.start - first.start;
  const double along_first = (apart.x() * b.y() - apart.y() * b.x()) / sine;
  const double along_second = (apart.x() * a.y() - apart.y() * a.x()) / sine;
  const auto within = [](double along, double length) {
    return along >= -same_vertex && along <= length + same_vertex;
  };
  if (!within(along_first, first_length) || !within(along_second, second_length)) {
    return std::nullopt;
  }
  // Ends stay as they are written.
  if (std::abs(along_first) <= exact) return first.start;
  if (std::abs(along_first - first_length) <= exact) return first.end;
  if (std::abs(along_second) <= exact) return second.start;
  if (std::abs(along_second - second_length) <= exact) return second.end;
  return first.start + along_first * a;
}

void World::add_polyline(const std::vector<Eigen::Vector2d>& points, bool closed) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) walls.push_back({points[i], points[i + 1]});
  if (closed && points.size() > 2) walls.push_back({points.back(), points.front()});
}

std::vector<Eigen::Vector2d> World::corners() const {
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t k = i + 1; k < walls.size(); ++k) {
      const auto point = meeting_point(walls[i], walls[k]);
      if (!point) continue;
      const bool known = std::ranges::any_of(corners, [&](const Eigen::Vector2d& corner) {
        return (corner - *point).norm() <= same_vertex;
      });
      if (!known) corners.push_back(*point);
    }
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
    if (along <= step && step > 0.0) return pose_between(path[i], path[i + 1], along / step);
    along -= step;
  }
  return path.back();
}

}  // namespace quoin
