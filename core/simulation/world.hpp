// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/pose.hpp"

namespace quoin {

/// A straight wall between two points [m].
struct Wall {
  Eigen::Vector2d start;
  Eigen::Vector2d end;
};

/// Where two walls meet [m]: at a common end, where one ends on the other, or where they cross, all
/// within 1 mm. Nothing for walls that are apart or parallel.
[[nodiscard]] std::optional<Eigen::Vector2d> meeting_point(const Wall& first, const Wall& second);

/// A round obstacle such as a table leg.
struct Pillar {
  Eigen::Vector2d center;  ///< [m]
  double radius = 0.0;     ///< [m]
};

/// What a simulated sensor sees, and where it drives.
struct World {
  std::string name;
  std::string description;
  std::vector<Wall> walls;
  std::vector<Pillar> pillars;
  /// Way points of the sensor; a resting sensor stays at the first. Never empty in a valid world.
  std::vector<Pose2> path;

  /// Adds the walls of a polyline; `closed` joins the last point to the first.
  void add_polyline(const std::vector<Eigen::Vector2d>& points, bool closed);

  /// Points where walls meet that are not parallel, each once: the true corners [m].
  [[nodiscard]] std::vector<Eigen::Vector2d> corners() const;

  /// Pose after travelling `distance` [m] along the path there and back again; headings are
  /// interpolated between way points the short way round.
  [[nodiscard]] Pose2 pose_at(double distance) const;
};

/// Names of the worlds that are built in, the first being the default.
[[nodiscard]] std::vector<std::string> world_names();

/// A built-in world, or nothing when there is none of that name. `environment_a` and
/// `environment_b` follow the sizes, point and segment counts of the WCTLS paper's section 4,
/// `cwlf_environment_a` and `cwlf_environment_b` the sizes, segment and corner counts of the CWLF
/// paper's section V.
[[nodiscard]] std::optional<World> built_in_world(std::string_view name);

/// Rooms of 4 to 9 m with what a robot meets in them: cabinets and sofas along the walls, turned
/// tables and crates, table legs, bins, people's legs and heaps of small things, all placed at
/// random around a sensor that has at least half a metre of free space. Same seed, same rooms, and
/// the first ones do not depend on `count`.
[[nodiscard]] std::vector<World> cluttered_rooms(std::size_t count, std::uint64_t seed);

}  // namespace quoin
