// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/circle_fit.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"

namespace quoin {

Arc seen_arc(const Circle& circle, const PointsView& points) {
  constexpr std::size_t steps = 8;  // of a whole turn none is as long as half of one
  if (points.size() == 0) return {};
  const auto direction = [&](std::size_t i) {
    return std::atan2(points.y[i] - circle.center.y(), points.x[i] - circle.center.x());
  };
  const double first = direction(0);
  double before = first;
  double turned = 0.0;
  for (std::size_t k = 1; k <= steps; ++k) {
    const double next = direction((points.size() - 1) * k / steps);
    turned += normalized_angle(next - before);
    before = next;
  }
  // The sensor sees what is around it counter-clockwise, and the near side of a column clockwise.
  const bool concave = turned > 0.0;
  const double start = concave ? first : before;
  return {start, start + std::abs(turned), concave};
}

double scale_to_residuals(CircleFit& fit, std::size_t points) {
  if (points < 4) return 1.0;
  const double freedom = static_cast<double>(points - 3);
  // Wilson and Hilferty 1931: the cube root of chi square over its degrees of freedom is normal.
  constexpr double deviations = 3.090232306167813;  // exceeded once in 1000 times
  const double spread = 2.0 / (9.0 * freedom);
  const double root = 1.0 - spread + deviations * std::sqrt(spread);
  const double reduced = fit.chi_square / freedom;
  if (!(reduced > root * root * root)) return 1.0;
  fit.estimate.covariance *= reduced;
  return reduced;
}

}  // namespace quoin
