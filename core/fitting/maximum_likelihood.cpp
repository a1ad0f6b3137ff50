// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/maximum_likelihood.hpp"

#include <cmath>

#include "core/fitting/inverse_line.hpp"
#include "core/fitting/moments.hpp"
#include "core/fitting/offset_at_mean.hpp"
#include "core/fitting/weight_variances.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// A line by its unit normal and its offset from the mean of the points along that normal [m].
struct State {
  Eigen::Vector2d normal;
  double offset;
};

/// Fisher information of (alpha, offset) and the descent of half the sum of d^2 / v.
struct NormalEquations {
  Symmetric2 information;
  double alpha = 0.0;
  double offset = 0.0;
};

QUOIN_MULTIVERSION
void add_up(const double* __restrict cosine, const double* __restrict sine,
            const double* __restrict range, std::size_t count, double nx, double ny, double r,
            double tangential_mean, double range_variance, double bearing_variance,
            NormalEquations& out) {
  NormalEquations sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i] * nx + sine[i] * ny;
    const double s = sine[i] * nx - cosine[i] * ny;
    const double d = range[i] * c - r;
    const double t = range[i] * s - tangential_mean;
    const double across = range[i] * range[i] * bearing_variance;
    const double w = 1.0 / (range_variance * c * c + across * s * s);
    const double wd = w * d;
    const double wt = w * t;
    sums.information.xx += wt * t;
    sums.information.xy -= wt;
    sums.information.yy += w;
    // d' - d v' / (2 v)
    sums.alpha -= wd * (t - wd * s * c * (range_variance - across));
    sums.offset += wd;
  }
  out = sums;
}

/// The minimum if all points had the covariance of one at their mean: the generalised eigenvector
/// of their spread and that covariance.
State first_guess(const Moments& m, const WeightVariances& variances) {
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
  return {Eigen::Vector2d(c * u - s * v, s * u + c * v).normalized(), 0.0};
}

}  // namespace

FitResult MaximumLikelihood::operator()(const PointsView& points, const SensorModel& sensor) const {
  constexpr int most_iterations = 50;
  // A ten-millionth of a standard deviation.
  constexpr double small_step = 1e-14;
  constexpr double rounding = 1e-13;
  if (points.size() < 2) return FitResult::failed(FitFailure::too_few_points);
  const Moments m = moments_of(points, PointWeights::equal);
  if (!std::isfinite(m.trace())) return FitResult::failed(FitFailure::not_finite);
  if (!m.have_extent()) return FitResult::failed(FitFailure::degenerate);
  const WeightVariances variances(sensor);
  const Eigen::Vector2d mean(m.mean_x, m.mean_y);
  const double size = std::sqrt(mean.squaredNorm() + m.trace());
  State state = first_guess(m, variances);
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    const double tangential = state.normal.x() * mean.y() - state.normal.y() * mean.x();
    NormalEquations equations;
    add_up(points.cosine.data(), points.sine.data(), points.range.data(), points.size(),
           state.normal.x(), state.normal.y(), state.normal.dot(mean) + state.offset, tangential,
           variances.range, variances.bearing, equations);
    const auto step = solve_inverse_line(equations.information, equations.alpha, equations.offset);
    if (!step) {
      return FitResult::failed(std::isfinite(equations.information.xx) ? FitFailure::degenerate
                                                                       : FitFailure::not_finite);
    }
    const double turn = step->q.x();
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    state.normal = {c * state.normal.x() - s * state.normal.y(),
                    s * state.normal.x() + c * state.normal.y()};
    state.offset += step->q.y();
    if (turn * equations.alpha + step->q.y() * equations.offset <= small_step ||
        (std::abs(turn) < rounding && std::abs(step->q.y()) < rounding * size)) {
      const LineEstimate estimate = normalized({{direction_of(state.normal.x(), state.normal.y()),
                                                 state.normal.dot(mean) + state.offset},
                                                from_offset_at_mean(step->inverse, tangential)});
      FitResult result = FitResult::fitted(estimate.line, estimate.covariance);
      if (result.ok()) result.iterations = iteration;
      return result;
    }
  }
  return FitResult::failed(FitFailure::not_converged);
}

}  // namespace quoin
