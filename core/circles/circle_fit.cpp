// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/circle_fit.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/statistics/chi_square.hpp"

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
  const double factor = residual_scale(fit.chi_square, static_cast<double>(points) - 3.0);
  fit.estimate.covariance *= factor;
  return factor;
}

}  // namespace quoin
