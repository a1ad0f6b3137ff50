// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/core/fitting/fitting_fixtures.hpp"

#include <cmath>
#include <random>

#include "core/fitting/fitters.hpp"

namespace quoin {

Fitter make_fitter(const std::string& name, const char* covariance) {
  return Fitters::make<Fitter>(name, {{"covariance", covariance}});
}

std::vector<std::string> fitter_names() {
  std::vector<std::string> names;
  for (const MethodInfo& method : Fitters::descriptions()) names.push_back(method.name);
  return names;
}

Points first_wall(const SensorModel& noise) {
  std::mt19937_64 engine(3);
  return wall_points({0.4, 1.7}, 0.1, 0.9, 60, noise, engine);
}
Points second_wall(const SensorModel& noise) {
  std::mt19937_64 engine(4);
  return wall_points({1.8, 2.3}, 1.0, 1.7, 45, noise, engine);
}

Eigen::Matrix2d numerical_covariance(const Fitter& fitter, const Points& points,
                                     const SensorModel& sensor, const SensorModel& noise) {
  const double h = 1e-6;
  const auto moved = [&](std::size_t i, double d_range, double d_bearing) {
    std::vector<double> bearings = points.bearing;
    std::vector<double> ranges = points.range;
    bearings[i] += d_bearing;
    ranges[i] += d_range;
    const Line line = fitter(points_from(bearings, ranges), sensor).estimate.line;
    return Eigen::Vector2d(line.alpha, line.r);
  };
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d g = (moved(i, h, 0) - moved(i, -h, 0)) / (2 * h) *
                              std::sqrt(noise.range_variance(points.range[i]));
    const Eigen::Vector2d k = (moved(i, 0, h) - moved(i, 0, -h)) / (2 * h) * noise.bearing_stddev;
    covariance += g * g.transpose() + k * k.transpose();
  }
  return covariance;
}

Eigen::Matrix2d cramer_rao_bound(const Line& line, const std::vector<double>& bearings,
                                 const SensorModel& sensor) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const double bearing : bearings) {
    const double phi = bearing - line.alpha;
    const double range = line.r / std::cos(phi);
    const Eigen::Vector2d derivative(-range * std::tan(phi), 1.0 / std::cos(phi));
    const double across = range * std::tan(phi) * sensor.bearing_stddev;
    information +=
        derivative * derivative.transpose() / (sensor.range_variance(range) + across * across);
  }
  const double determinant =
      information(0, 0) * information(1, 1) - information(0, 1) * information(1, 0);
  Eigen::Matrix2d bound;
  bound << information(1, 1), -information(0, 1), -information(1, 0), information(0, 0);
  return bound / determinant;
}

}  // namespace quoin
