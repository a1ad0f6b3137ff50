// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/inverse_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angle.hpp"

namespace quoin {

std::optional<InverseLine> solve_inverse_line(const Symmetric2& m, double vx, double vy) {
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

void add_bearing_bias(const InverseLine& line, double bearing_variance, Symmetric2& influence) {
  const Eigen::Vector2d bias = bearing_variance * (1.5 * line.v - line.trace * line.q);
  influence.xx += bias.x() * bias.x();
  influence.xy += bias.x() * bias.y();
  influence.yy += bias.y() * bias.y();
}

FitResult to_normal_form(const InverseLine& line, const Symmetric2& influence) {
  const double a = line.q.x();
  const double b = line.q.y();
  const double norm_squared = a * a + b * b;
  const double r = 1.0 / std::sqrt(norm_squared);

  // Rows of d(alpha, r)/d(A, B) M^-1. With the sign of y turned this is the chain of WCTLS eq. (23)
  // from Q to the unit normal and the distance, and on to alpha.
  const Symmetric2& w = line.inverse;
  const double alpha_a = -b / norm_squared;
  const double alpha_b = a / norm_squared;
  const double r_a = -a * r / norm_squared;
  const double r_b = -b * r / norm_squared;
  const double alpha_x = alpha_a * w.xx + alpha_b * w.xy;
  const double alpha_y = alpha_a * w.xy + alpha_b * w.yy;
  const double r_x = r_a * w.xx + r_b * w.xy;
  const double r_y = r_a * w.xy + r_b * w.yy;
  const auto product = [&influence](double ux, double uy, double vx, double vy) {
    return influence.xx * ux * vx + influence.xy * (ux * vy + uy * vx) + influence.yy * uy * vy;
  };
  Eigen::Matrix2d covariance;
  covariance(0, 0) = product(alpha_x, alpha_y, alpha_x, alpha_y);
  covariance(0, 1) = product(alpha_x, alpha_y, r_x, r_y);
  covariance(1, 0) = covariance(0, 1);
  covariance(1, 1) = product(r_x, r_y, r_x, r_y);
  return FitResult::fitted({direction_of(a, b), r}, covariance);
}

FitFailure reason_of_singularity(const PointsView& points) {
  double extent = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double square = points.x[i] * points.x[i] + points.y[i] * points.y[i];
    if (!std::isfinite(square) || square < std::numeric_limits<double>::min()) {
      return FitFailure::not_finite;
    }
    extent = std::max(
        {extent, std::abs(points.x[i] - points.x[0]), std::abs(points.y[i] - points.y[0])});
    size = std::max({size, std::abs(points.x[i]), std::abs(points.y[i])});
  }
  return extent > 1e-9 * size ? FitFailure::through_sensor : FitFailure::degenerate;
}

}  // namespace quoin
