// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/segmentation/segmenters.hpp"
#include "core/sensor/scan.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {

inline std::vector<std::string> segmenter_names() {
  std::vector<std::string> names;
  for (const MethodInfo& method : Segmenters::descriptions()) names.push_back(method.name);
  return names;
}

/// Points of one scan of `world` by a resting sensor, and where it rested.
struct ScannedWorld {
  Points points;
  Pose2 pose;
};

inline ScannedWorld scan_of(const World& world, const SensorModel& noise, std::uint64_t seed,
                            double distance = 0.0) {
  ScannerSettings settings;
  settings.noise = noise;
  SimulatedScanner scanner(world, settings, seed);
  SimulatedScan scan;
  scanner.scan(distance, 0.0, scan);
  ScannedWorld scanned;
  convert({scan.bearings, scan.ranges, 0.1F, 40.0F}, scanned.points);
  scanned.pose = world.pose_at(distance);
  return scanned;
}

inline Points noisy_points(const char* world, std::uint64_t seed) {
  return scan_of(built_in_world(world).value(), SensorModel{}, seed).points;
}

/// Walls through these corners as the sensor at the origin sees them without noise.
inline Points polyline_points(const std::vector<Eigen::Vector2d>& corners) {
  World world;
  world.add_polyline(corners, false);
  world.path = {{0.0, 0.0, 0.0}};
  return scan_of(world, {0.0, 0.0, 0.0}, 1).points;
}

/// The point nearest to `place` [m].
inline std::size_t nearest_point(const Points& points, const Eigen::Vector2d& place) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto distance = [&](std::size_t k) {
      return (Eigen::Vector2d(points.x[k], points.y[k]) - place).norm();
    };
    if (distance(i) < distance(nearest)) nearest = i;
  }
  return nearest;
}

template <class Method>
std::vector<Segment> segments_by(const Points& points,
                                 const typename Method::Parameters& parameters = {},
                                 const SensorModel& sensor = {}) {
  Method method(parameters);
  Segmentation found;
  method(points, sensor, found);
  return found.segments;
}

/// Those of at least `fewest` points.
inline std::vector<Segment> long_ones(const std::vector<Segment>& segments, std::size_t fewest) {
  std::vector<Segment> kept;
  for (const Segment& segment : segments) {
    if (segment.size() >= fewest) kept.push_back(segment);
  }
  return kept;
}

}  // namespace quoin
