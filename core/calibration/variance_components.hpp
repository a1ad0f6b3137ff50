// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "core/calibration/noise_estimate.hpp"
#include "core/calibration/wall_residuals.hpp"

namespace quoin {

/// The components that the residuals of these walls of the table show; `start` is where the
/// iteration begins. All zero without walls.
[[nodiscard]] NoiseComponents find_components(const ResidualTable& table,
                                              std::span<const WallResiduals> walls,
                                              const SensorModel& start);

/// Variance [m^2] of the distance from the line that the model gives the points of a block, that by
/// the flatness of walls included.
[[nodiscard]] double variance_of(const ResidualBlock& block, const SensorModel& model);

/// Sum over a wall of squared residuals over their variances.
[[nodiscard]] double chi_square(const ResidualTable& table, const WallResiduals& wall,
                                const SensorModel& model);

}  // namespace quoin
