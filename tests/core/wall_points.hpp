// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "core/geometry/line.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Points given by bearing and range.
inline Points points_from(const std::vector<double>& bearings, const std::vector<double>& ranges) {
  Points points;
  points.resize(bearings.size());
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    points.bearing[i] = bearings[i];
    points.range[i] = ranges[i];
    points.inverse_range[i] = 1.0 / ranges[i];
    points.cosine[i] = std::cos(bearings[i]);
    points.sine[i] = std::sin(bearings[i]);
    points.x[i] = ranges[i] * points.cosine[i];
    points.y[i] = ranges[i] * points.sine[i];
  }
  return points;
}

/// Points of a wall as seen under `count` equally spaced bearings, with the sensor's noise.
inline Points wall_points(const Line& line, double first_bearing, double last_bearing,
                          std::size_t count, const SensorModel& noise, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  std::vector<double> bearings(count);
  std::vector<double> ranges(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double bearing = first_bearing + (last_bearing - first_bearing) * static_cast<double>(i) /
                                               static_cast<double>(count - 1);
    const double range = line.r / std::cos(bearing - line.alpha);
    ranges[i] = range + std::sqrt(noise.range_variance(range)) * normal(engine);
    bearings[i] = bearing + noise.bearing_stddev * normal(engine);
  }
  return points_from(bearings, ranges);
}

inline Points exact_wall_points(const Line& line, double first_bearing, double last_bearing,
                                std::size_t count) {
  std::mt19937_64 engine(1);
  return wall_points(line, first_bearing, last_bearing, count, {0.0, 0.0, 0.0}, engine);
}

}  // namespace quoin
