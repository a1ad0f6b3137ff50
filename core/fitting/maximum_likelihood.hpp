// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/fit.hpp"

namespace quoin {

/// Minimises the sum of d^2 / v, with d = rho cos(phi) - r the distance of a point from the line
/// and v = sigma_rho^2 cos^2(phi) + rho^2 sigma_theta^2 sin^2(phi) the variance that range and
/// bearing noise give it, phi being the incidence angle. v turns with the line, and its derivative
/// is part of the gradient: that is what keeps the estimate free of the bias of orthogonal fits.
/// Defined for all lines, those through the sensor included, where a residual along the ray is not.
///
/// The covariance is the Cramer-Rao bound at the line in both modes: no paper prints another one.
class MaximumLikelihood {
 public:
  static constexpr const char* name = "maximum_likelihood";
  static constexpr const char* description =
      "iterated fit on the noise model of each ray; reaches the Cramer-Rao bound";
  static constexpr const char* source =
      "Newton iteration on the noise model of ranges and bearings";
  static constexpr const char* choose =
      "Where lines may pass through the sensor, or as the reference: attains the Cramer-Rao "
      "bound at any noise, with a covariance that holds. The noise model must be right, for it "
      "takes its weights from it.";

  using Parameters = CovarianceParameters;

  MaximumLikelihood() = default;
  explicit MaximumLikelihood(const Parameters&) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const;
};

}  // namespace quoin
