// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/maximum_likelihood_circle.hpp"

#include <cmath>

#include "core/circles/circle_residuals.hpp"

namespace quoin {
namespace {

/// Mean error of the estimate by the curvature of the distance in (x, y): d'' = t t^T / radius with
/// t the tangent, whose expectation over the estimate's own covariance acts like a residual (Box
/// 1971, "Bias in nonlinear estimation").
Eigen::Vector3d bias_of(const CircleSums& sums, const Eigen::Matrix3d& covariance, double radius) {
  // t t^T has the entries 1 - n_x^2, -n_x n_y and n_x^2, since n is a unit vector.
  const double xx = covariance(0, 0) / radius;
  const double xy = 2.0 * covariance(0, 1) / radius;
  const double yy = covariance(1, 1) / radius;
  const double xyy = sums.x - sums.xxx;
  const Eigen::Vector3d residual(xx * xyy - xy * sums.xxy + yy * sums.xxx,
                                 xx * (sums.y - sums.xxy) - xy * xyy + yy * sums.xxy,
                                 xx * sums.yy - xy * sums.xy + yy * sums.xx);
  return 0.5 * covariance * residual;
}

}  // namespace

CircleFit MaximumLikelihoodCircle::operator()(const PointsView& points,
                                              const SensorModel& sensor) const {
  constexpr int most_iterations = 30;
  constexpr double small_step = 1e-3;  // standard deviations, squared; convergence is fast
  if (points.size() < 3) return CircleFit::failed(CircleFailure::too_few_points);
  const auto start = fit_algebraic_circle(points, CircleConstraint::taubin);
  if (!start) return CircleFit::failed(CircleFailure::degenerate);
  const WeightVariances variances(sensor);
  CircleEstimate estimate;
  Circle& circle = estimate.circle;
  circle = *start;
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    CircleSums sums = circle_sums(points, circle, variances);
    const auto inverse = inverse_of(sums.information());
    if (!inverse) return CircleFit::failed(CircleFailure::degenerate);
    const Eigen::Vector3d step = *inverse * sums.gradient();
    const double change = step.dot(sums.gradient());
    circle.center += step.head<2>();
    circle.radius += step.z();
    // Noise as large as the circle leads through its centre.
    if (!(circle.radius > 0.0)) return CircleFit::failed(CircleFailure::not_determined);
    if (!(change <= small_step)) continue;
    const Eigen::Vector3d bias = bias_of(sums, *inverse, circle.radius);
    circle.center -= bias.head<2>();
    circle.radius -= bias.z();
    sums.chi_square -= change;
    estimate.covariance = *inverse;
    add_range_bias(points, sensor, true, estimate);
    CircleFit fit = judged(estimate, sums, points.size(), parameters_);
    if (fit.ok()) fit.iterations = iteration;
    return fit;
  }
  return CircleFit::failed(CircleFailure::not_converged);
}

}  // namespace quoin
