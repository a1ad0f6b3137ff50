// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/algebraic.hpp"

namespace quoin {

/// Weighted conformal total least squares. The line is found by the point Q = (cos alpha, -sin
/// alpha) / r of the inverted plane (eq. 16), with the weights of eq. (8); sigma_rho and
/// sigma_theta cancel in the line. The covariance is C_Q mapped by eq. (22) and (23), and on to
/// (alpha, r).
///
/// `as_published` is that: the paper takes C_Q from WCLM, where it is the sum of independent
/// contributions of the points already. `propagated` adds the bias that noise of the bearings gives
/// the line.
class Wctls {
 public:
  static constexpr const char* name = "wctls";
  static constexpr const char* description =
      "weighted conformal total least squares: the line by its point Q in the inverted plane";
  static constexpr const char* source = "Prieto-Fernandez et al. 2026, eq. 16-23";
  static constexpr const char* choose =
      "For the shortest time with a covariance that holds. Where the noise of the bearings is as "
      "large as their spacing, lines far from the foot of the perpendicular are biased; propagated "
      "counts that, and inverse_range is up to a tenth more accurate. Not within a few decimetres "
      "of the sensor.";

  using Parameters = CovarianceParameters;

  Wctls() = default;
  explicit Wctls(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    // q = (A, B) = (x_Q, -y_Q): the signs cancel in (alpha, r).
    return fit_algebraic(points, PointWeights::inverse_square_range, sensor,
                         parameters_.covariance == CovarianceMode::as_published
                             ? CountedErrors::independent
                             : CountedErrors::independent_and_bias);
  }

 private:
  Parameters parameters_;
};

}  // namespace quoin
