// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/symmetric2.hpp"

namespace quoin {

/// Solves M q = v, the normal equations of a fit of A x + B y = 1 with q = (A, B), and keeps M^-1.
/// Nothing when M is singular to rounding: all points lie on one ray or are equal. For UTLS and
/// WTLS det M is -c of WCTLS eq. (4) and (12).
struct InverseLine {
  Eigen::Vector2d q = Eigen::Vector2d::Zero();  ///< (cos alpha, sin alpha) / r [1/m]
  Symmetric2 inverse;                           ///< M^-1
  Eigen::Vector2d v = Eigen::Vector2d::Zero();
  double trace = 0.0;  ///< of M
};
[[nodiscard]] inline std::optional<InverseLine> solve_inverse_line(const Symmetric2& m, double vx,
                                                                   double vy) {
  // det M is the sum over pairs of squared cross products, so that it is compared with what
  // rounding leaves of M's own products; NaN fails the comparison.
  constexpr double rounding = 1e-13;
  const double determinant = m.xx * m.yy - m.xy * m.xy;
  const double half_trace = 0.5 * (m.xx + m.yy);
  if (!(determinant > rounding * half_trace * half_trace)) return std::nullopt;
  InverseLine line;
  const double scale = 1.0 / determinant;
  line.inverse = {m.yy * scale, -m.xy * scale, m.xx * scale};
  line.q = {line.inverse.xx * vx + line.inverse.xy * vy,
            line.inverse.xy * vx + line.inverse.yy * vy};
  line.v = {vx, vy};
  line.trace = m.xx + m.yy;
  return line;
}

/// Adds the square of the bias that noise of the bearings gives the line to the summed influences
/// on M q, whose expectation it makes that of the squared error. The noise turns the regressors p,
/// M = sum p p', v = sum p z: to second order M grows by sigma_theta^2 (tr(M) I - 2 M) and v by
/// -sigma_theta^2 v / 2, so that M q is off by sigma_theta^2 (3 v / 2 - tr(M) q).
void add_bearing_bias(const InverseLine& line, double bearing_variance, Symmetric2& influence);

/// The line in normal form and the covariance of (alpha, r) from M^-1 S M^-1, the covariance of q.
[[nodiscard]] FitResult to_normal_form(const InverseLine& line, const Symmetric2& influence);

/// Why the normal equations of these points are singular.
[[nodiscard]] FitFailure reason_of_singularity(const PointsView& points);

}  // namespace quoin
