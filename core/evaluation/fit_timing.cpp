// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/fit_timing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/sensor/points.hpp"
#include "core/simulation/random.hpp"

namespace quoin {
namespace {

constexpr double distance = 2.0;  // [m] of the walls from the sensor

/// `function` gives a number that depends on all that is to be computed.
template <class Function>
double seconds_per_wall(const std::vector<Points>& walls, const Function& function) {
  [[maybe_unused]] volatile double sink = 0.0;
  const double seconds = seconds_per_call([&] {
    for (const Points& wall : walls) sink = function(wall);
  });
  return seconds / static_cast<double>(walls.size());
}

}  // namespace

double seconds_per_call(const std::function<void()>& function, double run_time) {
  using Clock = std::chrono::steady_clock;
  constexpr int runs = 5;
  const auto time = [&function](long calls) {
    const auto start = Clock::now();
    for (long i = 0; i < calls; ++i) function();
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  long calls = 1;
  while (time(calls) < run_time) calls *= 2;
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    best = std::min(best, time(calls) / static_cast<double>(calls));
  }
  return best;
}

std::vector<Points> timing_walls(std::size_t points) {
  std::vector<Points> walls(points < 10000 ? 16 : 2);
  Random random(20260422);
  const SensorModel sensor;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    Points& wall = walls[k];
    wall.resize(points);
    const double alpha = -3.0 + 0.37 * static_cast<double>(k);
    for (std::size_t i = 0; i < points; ++i) {
      const double phi = -0.4 + static_cast<double>(i) / static_cast<double>(points);
      wall.range[i] = distance / std::cos(phi) + sensor.range_stddev * random.normal();
      wall.bearing[i] = alpha + phi + sensor.bearing_stddev * random.normal();
    }
    compute_cartesian(wall);
  }
  return walls;
}

std::vector<Points> timing_columns(std::size_t points) {
  std::vector<Points> columns(points < 10000 ? 16 : 2);
  Random random(20260422);
  const SensorModel sensor;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Points& column = columns[k];
    column.resize(points);
    const double radius = 0.2 + 0.1 * static_cast<double>(k);
    const double to_center = radius + distance;
    const double half = 0.98 * std::asin(radius / to_center);
    for (std::size_t i = 0; i < points; ++i) {
      const double off =
          half * (2.0 * static_cast<double>(i) / static_cast<double>(points - 1) - 1.0);
      const double across = to_center * std::sin(off);
      column.range[i] = to_center * std::cos(off) - std::sqrt(radius * radius - across * across) +
                        sensor.range_stddev * random.normal();
      column.bearing[i] =
          0.37 * static_cast<double>(k) + off + sensor.bearing_stddev * random.normal();
    }
    compute_cartesian(column);
  }
  return columns;
}

Eigen::Matrix2d plain_covariance(const PointsView& points) {
  const auto size = static_cast<Eigen::Index>(points.size());
  const Eigen::Map<const Eigen::ArrayXd> x(points.x.data(), size);
  const Eigen::Map<const Eigen::ArrayXd> y(points.y.data(), size);
  const double mean_x = x.mean();
  const double mean_y = y.mean();
  Eigen::Matrix2d covariance;
  covariance(0, 0) = (x - mean_x).square().sum();
  covariance(0, 1) = covariance(1, 0) = ((x - mean_x) * (y - mean_y)).sum();
  covariance(1, 1) = (y - mean_y).square().sum();
  return covariance / static_cast<double>(size - 1);
}

double seconds_per_fit(const Fitter& fitter, const std::vector<Points>& walls) {
  const SensorModel sensor;
  return seconds_per_wall(walls,
                          [&](const Points& wall) { return fitter(wall, sensor).estimate.line.r; });
}

double seconds_per_fit(const CircleFitter& fitter, const std::vector<Points>& columns) {
  const SensorModel sensor;
  return seconds_per_wall(
      columns, [&](const Points& column) { return fitter(column, sensor).estimate.circle.radius; });
}

double seconds_per_plain_covariance(const std::vector<Points>& walls) {
  // All entries, or the compiler leaves some out.
  return seconds_per_wall(walls, [](const Points& wall) { return plain_covariance(wall).sum(); });
}

}  // namespace quoin
