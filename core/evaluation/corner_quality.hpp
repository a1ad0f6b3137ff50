// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/extraction/extraction.hpp"
#include "core/sensor/points.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// How well the corners of simulated scans are found.
struct CornerQuality {
  std::size_t scans = 0;
  std::size_t true_corners = 0;
  std::size_t found_corners = 0;  ///< of the true ones
  std::size_t false_corners = 0;  ///< found ones near no true one
  Interval recall;                ///< found / true
  Interval coverage;              ///< of the found ones, those inside their 95 % ellipse
  double mean_nees = 0.0;         ///< squared Mahalanobis distance of the found ones; 2 expected

  [[nodiscard]] double false_per_100_scans() const {
    return scans > 0 ? 100.0 * static_cast<double>(false_corners) / static_cast<double>(scans)
                     : 0.0;
  }
};

/// Of a sensor, and of what disturbs it.
struct DisturbedScans {
  std::size_t rays = 920;  ///< per revolution
  SensorModel noise;
  double strays = 0.0;  ///< share of the rays that return from somewhere before the wall
  std::size_t scans = 200;
  std::uint64_t seed = 1;
};

/// An empty room of 5 x 3.5 m from places at least 0.4 m from its walls. A corner is found when one
/// is within 15 cm.
[[nodiscard]] CornerQuality judge_room_corners(Extraction& extraction,
                                               const DisturbedScans& disturbed);

/// A column of this radius [m], its surface at this distance [m], and nothing else: it has no
/// corners.
[[nodiscard]] CornerQuality judge_column(Extraction& extraction, double radius, double distance,
                                         const DisturbedScans& disturbed);

}  // namespace quoin
