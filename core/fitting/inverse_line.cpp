// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/inverse_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angle.hpp"

namespace quoin {

void add_bearing_bias(const InverseLine& line, double bearing_variance, Symmetric2& influence) {
  const Eigen::Vector2d bias = bearing_variance * (1.5 * line.v - line.trace * line.q);
  influence.xx += bias.x() * bias.x();
  influence.xy += bias.x() * bias.y();
  influence.yy += bias.y() * bias.y();
}

FitResult to_normal_form(const InverseLine& line, const Symmetric2& influence) {
  const double a = line.q.x();
  const double b = line.q.y();
  const double r_squared = 1.0 / (a * a + b * b);
  const double r = std::sqrt(r_squared);

  // Rows of d(alpha, r)/d(A, B) M^-1. With the sign of y turned this is the chain of WCTLS eq. (23)
  // from Q to the unit normal and the distance, and on to alpha.
  const Symmetric2& w = line.inverse;
  const double alpha_a = -b * r_squared;
  const double alpha_b = a * r_squared;
  const double r_a = -alpha_b * r;
  const double r_b = alpha_a * r;
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
  return FitResult::fitted({direction_of(a, b), r}, {a * r, b * r}, covariance);
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
