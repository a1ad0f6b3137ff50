// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"

namespace quoin {

/// Mean normalised squared error for a wall that runs past the sensor at distance r, its points
/// evenly 1 to 3 m along it; and how often there is a result.
struct NearWall {
  double nees = 0.0;
  double found = 0.0;
};
inline NearWall near_wall(const std::string& name, double r, const SensorModel& sensor) {
  const double alpha = 0.4;
  const Fitter fitter = make_fitter(name);
  std::mt19937_64 engine(17);
  std::normal_distribution<double> normal;
  const int trials = 2000;
  NearWall result;
  for (int k = 0; k < trials; ++k) {
    std::vector<double> bearings;
    std::vector<double> ranges;
    for (int i = 0; i < 40; ++i) {
      const double t = 1.0 + 2.0 * i / 39.0;
      bearings.push_back(alpha + std::atan2(t, r) + sensor.bearing_stddev * normal(engine));
      ranges.push_back(std::hypot(t, r) + sensor.range_stddev * normal(engine));
    }
    const FitResult fit = fitter(points_from(bearings, ranges), sensor);
    if (!fit.ok()) {
      EXPECT_EQ(fit.failure, FitFailure::through_sensor);
      continue;
    }
    LineEstimate e = fit.estimate;
    if (std::abs(normalized_angle(e.line.alpha - alpha)) > pi / 2) {  // seen from the other side
      e.line = {e.line.alpha + pi, -e.line.r};
      e.covariance(0, 1) = e.covariance(1, 0) = -e.covariance(0, 1);
    }
    const Eigen::Vector2d error(normalized_angle(e.line.alpha - alpha), e.line.r - r);
    result.nees += error.dot(e.covariance.inverse() * error);
    result.found += 1.0;
  }
  result.nees /= std::max(result.found, 1.0);
  result.found /= trials;
  return result;
}

}  // namespace quoin
