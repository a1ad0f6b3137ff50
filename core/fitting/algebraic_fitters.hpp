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
