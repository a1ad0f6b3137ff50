// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/algebraic.hpp"

namespace quoin {

/// Weighted total least squares of eq. (8) to (15): the algebraic fit of A x + B y = 1 with weights
/// 1 / (sigma_rho rho sigma_theta)^2; the standard deviations cancel in the line. Same line as
/// WCTLS.
///
/// `as_published` reads eq. (13) with a Jacobian of two columns, the sums over all points: one
/// range error and one bearing error common to the whole segment. That reading gives the paper's
/// tables.
class Wtls {
 public:
  static constexpr const char* name = "wtls";
  static constexpr const char* description = "algebraic line fit with weights 1 / range^2";
  static constexpr const char* source = "Prieto-Fernandez et al. 2026, eq. 8-15";
  static constexpr const char* choose =
      "To compare with wctls, nothing else: it gives the same line and the same propagated "
      "covariance. Its as_published ellipses are far too large and serve to repeat the paper's "
      "tables only.";

  using Parameters = CovarianceParameters;

  Wtls() = default;
  explicit Wtls(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    return fit_algebraic(points, PointWeights::inverse_square_range, sensor,
                         parameters_.covariance == CovarianceMode::as_published
                             ? CountedErrors::common
                             : CountedErrors::independent_and_bias);
  }

 private:
  Parameters parameters_;
};

}  // namespace quoin
