// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/fit.hpp"

namespace quoin {

/// Regression of the inverse range on (cos, sin) of the bearing, like WTLS and WCTLS, but each ray
/// weighted with the variance of its inverse range: 1 / (sigma_rho^2 z^4 + sigma_theta^2 z'^2) with
/// z and its slope z' with the bearing taken from the line of equal weights, and 1 / rho taken to
/// first order about z, without which the regression is biased. As good as maximum likelihood
/// without an iteration: a second reweighting changes nothing that matters. Not defined for lines
/// so near the sensor that bearing noise is not small against the bearings of the segment.
///
/// The covariance is the Cramer-Rao bound in both modes: no paper prints another one.
class InverseRange {
 public:
  static constexpr const char* name = "inverse_range";
  static constexpr const char* description =
      "inverse range regressed with the variance of each ray; reaches the Cramer-Rao bound";
  static constexpr const char* source =
      "weighted least squares on the noise model of ranges and bearings";
  static constexpr const char* choose =
      "For the optimal weights without an iteration, at up to about 10 mm of noise. Not at 50 mm: "
      "there it refuses short and near walls (through_sensor), and what it still fits is hardly "
      "better than with wctls.";

  using Parameters = CovarianceParameters;

  InverseRange() = default;
  explicit InverseRange(const Parameters&) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const;
};

}  // namespace quoin
