// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/point_sums.hpp"

namespace quoin {

/// Regression line v = slope (u - mean) + intercept with (u, v) = (x, y), or (y, x) when the points
/// spread further along y (Vandorpe's choice, CWLF eq. 20 and 21). Not a NormalLine: the covariance
/// belongs to slope and intercept, and so do the equations.
struct AxisRegression {
  FitFailure failure = FitFailure::none;
  bool y_on_x = true;
  double slope = 0.0;
  double intercept = 0.0;  ///< [m] v at the mean of u
  double mean = 0.0;       ///< [m] weighted mean of u
  double weight = 0.0;     ///< sum of the weights
  double spread = 0.0;     ///< weighted sum of (u - mean)^2
  double residual = 0.0;   ///< weighted sum of the squares of what is left of v
  Line line;               ///< the same in normal form
  bool turned = false;     ///< whether the normal form's normal points to -v
};

/// How the ordinates are weighted.
enum class AxisWeights {
  equal,
  conditional,  ///< inverse of the variance of v given u, CWLF eq. (23) and (34)
};

/// The weights are of one range variance, `variances.range`.
[[nodiscard]] AxisRegression fit_axis(const PointsView& points, AxisWeights weights,
                                      const WeightVariances& variances);

/// Covariance of (slope, intercept) as the sum of the first-order contributions of range and
/// bearing noise of each point, in both coordinates and in the weights.
[[nodiscard]] Symmetric2 axis_covariance(const PointsView& points, AxisWeights weights,
                                         const AxisRegression& fit, const SensorModel& sensor);

/// Covariance of (alpha, r) from that of (slope, intercept).
[[nodiscard]] Eigen::Matrix2d to_normal_form(const AxisRegression& fit,
                                             const Symmetric2& covariance);

}  // namespace quoin
