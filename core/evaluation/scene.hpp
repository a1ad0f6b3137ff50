// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/line.hpp"
#include "core/geometry/pose.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/world.hpp"

namespace quoin {

/// A run of neighbouring rays that meet one wall, without noise, in the sensor's frame.
struct VisibleWall {
  std::size_t wall = 0;  ///< index in World::walls
  Line line;
  std::vector<double> bearings;  ///< [rad] counter-clockwise
  std::vector<double> ranges;    ///< [m]
};

/// Where two neighbouring visible walls meet.
struct VisibleCorner {
  Eigen::Vector2d position;  ///< [m] in the sensor's frame
  std::size_t first = 0;     ///< index in Scene::walls
  std::size_t second = 0;
};

/// The true segmentation and the true corners of what a resting sensor sees.
struct Scene {
  std::vector<VisibleWall> walls;  ///< counter-clockwise, only those of at least `min_points` rays
  std::vector<VisibleCorner> corners;
};

/// The line of a wall in the frame of `pose`.
[[nodiscard]] Line wall_line(const Wall& wall, const Pose2& pose);

/// The scene of `rays` evenly spaced rays all around from `pose`. Walls of fewer than `min_points`
/// rays are left out, as the segmenters' default does.
[[nodiscard]] Scene observe(const World& world, const Pose2& pose, std::size_t rays,
                            std::size_t min_points = 6);

/// The points of a wall as measured with noise, independent for each range and bearing.
void measure(const VisibleWall& wall, const SensorModel& noise, Random& random, Points& points);

}  // namespace quoin
