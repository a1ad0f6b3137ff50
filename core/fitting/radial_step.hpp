// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/inverse_line.hpp"
#include "core/fitting/weight_variances.hpp"

namespace quoin {

/// A line corrected once towards the points by Gauss-Newton. With z = A cos + B sin the inverse
/// range at which a ray meets the line q = (A, B), its residual is range - 1 / z, weighted with the
/// variance that range and bearing noise give it.
///
/// It is a step of weighted regression of the inverse range as well, with 1 / range taken to first
/// order about z: the second order makes the mean of 1 / range larger than the inverse of the mean
/// and the regression biased.
///
/// Fails as `through_sensor` where bearing noise is not small against the bearings of the segment
/// and would bias the regression, in which they have to be exact, beyond its standard deviation.
struct RadialStep {
  FitFailure failure = FitFailure::none;
  InverseLine line;        ///< with the inverse of `information`
  Symmetric2 information;  ///< Fisher information of q about the line before the step [m^2]
};

[[nodiscard]] RadialStep radial_step(const PointsView& points, const Eigen::Vector2d& q,
                                     const WeightVariances& variances);

}  // namespace quoin
