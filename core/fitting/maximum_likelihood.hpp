// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/fit.hpp"

namespace quoin {

/// Minimises the sum of (rho - r / cos(phi))^2 / V by Gauss-Newton, with V the variance that range
/// and bearing noise give the radial residual, taken anew from the line of each step. Started from
/// the regression of the inverse range with equal weights. Rays that run along the line, cos(phi) <
/// 0.03, count as if they met it at that angle.
///
/// The covariance is the Cramer-Rao bound at the line in both modes: no paper prints another one.
class MaximumLikelihood {
 public:
  static constexpr const char* name = "maximum_likelihood";
  static constexpr const char* description =
      "iterated fit of the radial residuals; reaches the Cramer-Rao bound";
  static constexpr const char* source = "Gauss-Newton on the noise model of ranges and bearings";

  using Parameters = CovarianceParameters;

  MaximumLikelihood() = default;
  explicit MaximumLikelihood(const Parameters&) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const;
};

}  // namespace quoin
