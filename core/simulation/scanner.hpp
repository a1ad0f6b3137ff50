// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry/pose.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/world.hpp"

namespace quoin {

/// What a ray meets first.
struct Hit {
  static constexpr std::size_t no_wall = std::numeric_limits<std::size_t>::max();

  double distance = std::numeric_limits<double>::infinity();  ///< [m]; +inf when it meets nothing
  std::size_t wall = no_wall;  ///< index in World::walls; `no_wall` for a pillar or nothing
};

/// From `origin` along the unit vector `direction`.
[[nodiscard]] Hit cast_ray(const World& world, const Eigen::Vector2d& origin,
                           const Eigen::Vector2d& direction);

/// A scan in the order of acquisition (counter-clockwise), as a sensor would report it.
struct SimulatedScan {
  std::vector<float> bearings;      ///< [rad] as reported, with noise
  std::vector<float> ranges;        ///< [m] as reported; NaN dropped out, +inf no return
  std::vector<float> time_offsets;  ///< [s] after the first ray
  std::vector<std::size_t> walls;   ///< Hit::wall of each ray: the truth
};

struct ScannerSettings {
  std::size_t points = 920;                        ///< rays per revolution
  double first_bearing = -3.14159265358979323846;  ///< [rad]
  double field_of_view = 6.283185307179586;        ///< [rad]
  double period = 0.1;                             ///< [s] per revolution
  double range_min = 0.1;                          ///< [m]
  double range_max = 40.0;                         ///< [m]
  SensorModel noise;        ///< standard deviations of the noise that is applied
  double range_bias = 0.0;  ///< [m] added to each range
  double dropout = 0.0;     ///< probability that a ray gives no range
};

/// A spinning LiDAR in a world: casts each ray from where the sensor is at that moment, and adds
/// seeded noise to bearing and range. The start of each revolution falls anywhere between two rays
/// (the spacing of rays is not a divisor of the revolution on real sensors), so bearings differ
/// from scan to scan. Same seed, same scans, on every machine.
class SimulatedScanner {
 public:
  SimulatedScanner(World world, const ScannerSettings& settings, std::uint64_t seed);

  /// One revolution while the sensor moves along the world's path at `speed` [m/s], the first ray
  /// being cast at `distance` [m] along it.
  void scan(double distance, double speed, SimulatedScan& out);

  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const ScannerSettings& settings() const { return settings_; }

 private:
  World world_;
  ScannerSettings settings_;
  Random random_;
};

}  // namespace quoin
