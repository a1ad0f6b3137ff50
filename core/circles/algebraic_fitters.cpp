// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/algebraic_fitters.hpp"

#include "core/circles/circle_residuals.hpp"

namespace quoin {
namespace {

/// The constraint's derivatives bring the mean squared distance into the equations of the centre,
/// of the radius or of both.
Eigen::Vector3d bias_of(const EqualWeights& noise, CircleConstraint constraint) {
  switch (constraint) {
    case CircleConstraint::pratt:
      return noise.bias + noise.by_radius;
    case CircleConstraint::hyper:
      return noise.bias - 2.0 * noise.by_scale - noise.by_radius;
    case CircleConstraint::taubin:
      break;
  }
  return noise.bias - noise.by_scale;
}

}  // namespace

CircleFit fit_algebraic(const PointsView& points, const SensorModel& sensor,
                        CircleConstraint constraint, const CircleParameters& parameters) {
  if (points.size() < 3) return CircleFit::failed(CircleFailure::too_few_points);
  const auto found = fit_algebraic_circle(points, constraint);
  if (!found) return CircleFit::failed(CircleFailure::degenerate);
  const WeightVariances variances(sensor);
  const auto noise = equal_weights(points, *found, variances);
  if (!noise) return CircleFit::failed(CircleFailure::degenerate);
  const Eigen::Vector3d bias = bias_of(*noise, constraint);
  CircleEstimate estimate{{found->center - bias.head<2>(), found->radius - bias.z()},
                          noise->covariance};
  if (!(estimate.circle.radius > 0.0)) return CircleFit::failed(CircleFailure::not_determined);
  add_range_bias(points, sensor, false, estimate);
  const CircleSums sums = circle_sums(points, estimate.circle, variances);
  return judged(estimate, sums, points.size(), parameters);
}

}  // namespace quoin
