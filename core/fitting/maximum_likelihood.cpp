// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/maximum_likelihood.hpp"

#include <cmath>
#include <limits>

#include "core/fitting/normal_residuals.hpp"

namespace quoin {
namespace {

/// The minimum if all points had the covariance of one at their mean: the generalised eigenvector
/// of their spread and that covariance.
NormalLine first_guess(const CentralMoments& m, const WeightVariances& variances) {
  const double distance = std::hypot(m.mean_x, m.mean_y);
  const double c = distance > 0.0 ? m.mean_x / distance : 1.0;
  const double s = distance > 0.0 ? m.mean_y / distance : 0.0;
  const double square = distance * distance + m.trace() / m.weight;
  const double along = 1.0 / std::sqrt(variances.range_at(square));
  const double across = 1.0 / std::sqrt(variances.bearing * square);
  // Spread along and across the ray, in standard deviations.
  const Symmetric2& p = m.scatter;
  const double xx = along * along * (c * c * p.xx + 2.0 * c * s * p.xy + s * s * p.yy);
  const double xy = along * across * (c * s * (p.yy - p.xx) + (c * c - s * s) * p.xy);
  const double yy = across * across * (s * s * p.xx - 2.0 * c * s * p.xy + c * c * p.yy);
  const double angle = 0.5 * std::atan2(-2.0 * xy, yy - xx);
  const double u = along * std::cos(angle);
  const double v = across * std::sin(angle);
  const Eigen::Vector2d normal = Eigen::Vector2d(c * u - s * v, s * u + c * v).normalized();
  return {normal.x(), normal.y(), normal.x() * m.mean_x + normal.y() * m.mean_y};
}

}  // namespace

FitResult MaximumLikelihood::operator()(const PointsView& points, const SensorModel& sensor) const {
  constexpr int most_iterations = 50;
  // A ten-millionth of a standard deviation.
  constexpr double small_step = 1e-14;
  constexpr double rounding = 1e-13;
  constexpr double longest_turn = 0.3;  // [rad]; Newton's steps are to be trusted near the end
  if (points.size() < 2) return FitResult::failed(FitFailure::too_few_points);
  const CentralMoments m = central_moments(points, PointWeights::equal);
  if (!std::isfinite(m.trace())) return FitResult::failed(FitFailure::not_finite);
  if (!m.have_extent()) return FitResult::failed(FitFailure::degenerate);
  const WeightVariances variances(sensor);
  const double size = std::sqrt(m.mean_x * m.mean_x + m.mean_y * m.mean_y + m.trace());
  const Eigen::Vector2d anchor(m.mean_x, m.mean_y);
  NormalLine line = first_guess(m, variances);
  NormalLine accepted = line;
  // Variances that grow with the range stay as they are while the sum is minimised, and are taken
  // anew at its minimum.
  NormalLine variance_line = line;
  int renewals = variances.range_growth > 0.0 ? 2 : 0;
  double lowest = std::numeric_limits<double>::infinity();
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    const NormalResiduals sums =
        normal_residuals_with_hessian(points, line, anchor, variances, variance_line);
    // A step that leads uphill, by more than rounding, is shortened.
    if (sums.value > lowest * (1.0 + 1e-9)) {
      step *= 0.25;
      line = moved(accepted, anchor, step);
      continue;
    }
    // Newton's step, or Fisher's where the sum is not convex.
    const auto fisher = solve2x2(sums.information, -sums.gradient);
    if (!fisher) {
      return FitResult::failed(std::isfinite(sums.information.xx) ? FitFailure::degenerate
                                                                  : FitFailure::not_finite);
    }
    const auto newton =
        solve2x2({sums.hessian_xx, sums.hessian_xy, sums.information.yy}, -sums.gradient);
    const bool convex = newton && sums.hessian_xx > 0.0 && std::abs(newton->x.x()) < longest_turn;
    step = convex ? newton->x : fisher->x;
    accepted = line;
    lowest = sums.value;
    line = moved(line, anchor, step);
    if (-step.dot(sums.gradient) <= small_step ||
        (std::abs(step.x()) < rounding && std::abs(step.y()) < rounding * size)) {
      if (renewals-- > 0) {
        variance_line = line;
        lowest = std::numeric_limits<double>::infinity();
        continue;
      }
      FitResult result = fitted(line, anchor, sums);
      if (result.ok()) result.iterations = iteration;
      return result;
    }
  }
  return FitResult::failed(FitFailure::not_converged);
}

}  // namespace quoin
