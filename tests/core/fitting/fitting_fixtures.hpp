// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {

Fitter make_fitter(const std::string& name, const char* covariance = "propagated");

std::vector<std::string> fitter_names();

/// The two that reach the Cramer-Rao bound and report it.
inline bool is_efficient(const std::string& name) {
  return name == "maximum_likelihood" || name == "inverse_range";
}

/// Range and bearing noise of an RPLIDAR S1 taken at its worst.
inline const SensorModel noisy{0.05, 0.0068, 0.0};

Points first_wall(const SensorModel& noise = noisy);
Points second_wall(const SensorModel& noise = noisy);

/// First-order covariance of (alpha, r) with the derivatives taken by central differences of the
/// fitter itself. `noise` weighs the contributions, `sensor` is what the fitter is told.
Eigen::Matrix2d numerical_covariance(const Fitter& fitter, const Points& points,
                                     const SensorModel& sensor, const SensorModel& noise);

/// Inverse of the Fisher information of (alpha, r) that rays under these bearings give of a line.
Eigen::Matrix2d cramer_rao_bound(const Line& line, const std::vector<double>& bearings,
                                 const SensorModel& sensor);

}  // namespace quoin
