// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/sensor/points.hpp"
#include "core/sensor/scan.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"

namespace quoin {

/// Of a sensor, and of what disturbs it.
struct DisturbedScans {
  std::size_t rays = 920;  ///< per revolution
  SensorModel noise = {};
  double strays = 0.0;  ///< share of the rays that return from somewhere before the wall
  std::size_t scans = 200;
  std::uint64_t seed = 1;
  double dropout = 0.0;  ///< share of the rays that do not return
};

/// Scans of a world from the first pose of its path.
class DisturbedScanner {
 public:
  DisturbedScanner(const World& world, const DisturbedScans& disturbed, std::uint64_t seed);

  /// The next scan, valid until the one after it. The wall of a stray is Hit::no_wall.
  [[nodiscard]] const SimulatedScan& scan();
  /// The last scan with the limits of the scanner.
  [[nodiscard]] ScanView view() const;

 private:
  SimulatedScanner scanner_;
  double strays_;
  Random random_;
  SimulatedScan scan_;
};

}  // namespace quoin
