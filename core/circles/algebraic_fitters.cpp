// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/algebraic_fitters.hpp"

#include "core/circles/circle_residuals.hpp"

namespace quoin {

CircleFit fit_algebraic(const PointsView& points, const SensorModel& sensor,
                        CircleConstraint constraint, const CircleParameters& parameters) {
  if (points.size() < 3) return CircleFit::failed(CircleFailure::too_few_points);
  const auto circle = fit_algebraic_circle(points, constraint);
  if (!circle) return CircleFit::failed(CircleFailure::degenerate);
  const PolarVariances variances(sensor);
  const auto covariance = equal_weights_covariance(points, *circle, variances);
  if (!covariance) return CircleFit::failed(CircleFailure::degenerate);
  CircleEstimate estimate{*circle, *covariance};
  add_range_bias(points, sensor, false, estimate);
  return judged(estimate, circle_sums(points, *circle, variances), points.size(), parameters);
}

}  // namespace quoin
