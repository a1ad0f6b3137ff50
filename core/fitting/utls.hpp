// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/algebraic.hpp"

namespace quoin {

/// The unweighted fit of eq. (1) to (7), minimising the sum of (A x + B y - 1)^2. It is known as
/// total least squares but is algebraic: not orthogonal, and dependent on where the sensor is.
///
/// `as_published` reads eq. (5) with a Jacobian of two columns, the sums over all points: one range
/// error and one bearing error common to the whole segment. That reading gives the paper's tables.
class Utls {
 public:
  static constexpr const char* name = "utls";
  static constexpr const char* description = "algebraic line fit with equal weights";
  static constexpr const char* source = "Siadat et al. 1997; Prieto-Fernandez et al. 2026, eq. 1-7";
  static constexpr const char* choose =
      "For the shortest time: in the worlds measured it is as accurate as wctls. Its as_published "
      "ellipses are far too large and serve to repeat the tables of papers only; it cannot express "
      "lines through the sensor.";

  using Parameters = CovarianceParameters;

  Utls() = default;
  explicit Utls(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    return fit_algebraic(points, PointWeights::equal, sensor,
                         parameters_.covariance == CovarianceMode::as_published
                             ? CountedErrors::common
                             : CountedErrors::independent_and_bias);
  }

 private:
  Parameters parameters_;
};

}  // namespace quoin
