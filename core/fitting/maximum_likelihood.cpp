// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/maximum_likelihood.hpp"

#include <cmath>
#include <limits>

#include "core/fitting/moments.hpp"
#include "core/fitting/normal_residuals.hpp"

namespace quoin {
namespace {

/// The minimum if all points had the covariance of one at their mean: the generalised eigenvector
/// of their spread and that covariance.
AnchoredLine first_guess(const Moments& m, const WeightVariances& variances) {
  const double distance = std::hypot(m.mean_x, m.mean_y);
  const double c = distance > 0.0 ? m.mean_x / distance : 1.0;
  const double s = distance > 0.0 ? m.mean_y / distance : 0.0;
  const double square = distance * distance + m.trace() / m.weight;
  const double along = 1.0 / std::sqrt(variances.range);
  const double across = 1.0 / std::sqrt(variances.bearing * square);
  // Spread along and across the ray, in standard deviations.
  const Symmetric2& p = m.spread;
  const double xx = along * along * (c * c * p.xx + 2.0 * c * s * p.xy + s * s * p.yy);
  const double xy = along * across * (c * s * (p.yy - p.xx) + (c * c - s * s) * p.xy);
  const double yy = across * across * (s * s * p.xx - 2.0 * c * s * p.xy + c * c * p.yy);
  const double angle = 0.5 * std::atan2(-2.0 * xy, yy - xx);
  const double u = along * std::cos(angle);
  const double v = across * std::sin(angle);
  return {{m.mean_x, m.mean_y}, Eigen::Vector2d(c * u - s * v, s * u + c * v).normalized(), 0.0};
}

}  // namespace

FitResult MaximumLikelihood::operator()(const PointsView& points, const SensorModel& sensor) const {
  constexpr int most_iterations = 50;
  // A ten-millionth of a standard deviation.
  constexpr double small_step = 1e-14;
  constexpr double rounding = 1e-13;
  constexpr double longest_turn = 0.3;  // [rad]; Newton's steps are to be trusted near the end
  if (points.size() < 2) return FitResult::failed(FitFailure::too_few_points);
  const Moments m = moments_of(points, PointWeights::equal);
  if (!std::isfinite(m.trace())) return FitResult::failed(FitFailure::not_finite);
  if (!m.have_extent()) return FitResult::failed(FitFailure::degenerate);
  const WeightVariances variances(sensor);
  const double size = std::sqrt(m.mean_x * m.mean_x + m.mean_y * m.mean_y + m.trace());
  AnchoredLine line = first_guess(m, variances);
  AnchoredLine accepted = line;
  double lowest = std::numeric_limits<double>::infinity();
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    const NormalResiduals sums = normal_residuals_with_curvature(points, line, variances);
    // A step that leads uphill, by more than rounding, is shortened.
    if (sums.value > lowest * (1.0 + 1e-9)) {
      step *= 0.25;
      line = accepted.moved(step);
      continue;
    }
    // Newton's step, or Fisher's where the sum is not convex.
    const auto fisher = solve_inverse_line(sums.information, sums.descent_x, sums.descent_y);
    if (!fisher) {
      return FitResult::failed(std::isfinite(sums.information.xx) ? FitFailure::degenerate
                                                                  : FitFailure::not_finite);
    }
    const auto newton =
        solve_inverse_line({sums.xx, sums.xy, sums.information.yy}, sums.descent_x, sums.descent_y);
    const bool convex = newton && sums.xx > 0.0 && std::abs(newton->q.x()) < longest_turn;
    step = convex ? newton->q : fisher->q;
    accepted = line;
    lowest = sums.value;
    line = line.moved(step);
    if (step.x() * sums.descent_x + step.y() * sums.descent_y <= small_step ||
        (std::abs(step.x()) < rounding && std::abs(step.y()) < rounding * size)) {
      FitResult result = fitted(line, sums);
      if (result.ok()) result.iterations = iteration;
      return result;
    }
  }
  return FitResult::failed(FitFailure::not_converged);
}

}  // namespace quoin
