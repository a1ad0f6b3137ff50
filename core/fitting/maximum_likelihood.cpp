// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/maximum_likelihood.hpp"

#include <cmath>
#include <limits>

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

  [[nodiscard]] State moved(const Eigen::Vector2d& step) const {
    const double c = std::cos(step.x());
    const double s = std::sin(step.x());
    return {{c * normal.x() - s * normal.y(), s * normal.x() + c * normal.y()}, offset + step.y()};
  }
};

/// Derivatives of half the sum of d^2 / v with (alpha, offset).
struct Derivatives {
  double value = 0.0;      ///< sum of d^2 / v
  Symmetric2 information;  ///< of Fisher: what the second derivatives are expected to be
  double xx = 0.0;         ///< second derivatives where they differ from that
  double xy = 0.0;
  double descent_x = 0.0;  ///< first derivatives, turned downhill
  double descent_y = 0.0;
};

QUOIN_MULTIVERSION
void add_up(const double* __restrict cosine, const double* __restrict sine,
            const double* __restrict range, std::size_t count, double nx, double ny, double r,
            double tangential_mean, double offset, double range_variance, double bearing_variance,
            Derivatives& out) {
  Derivatives sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i] * nx + sine[i] * ny;
    const double s = sine[i] * nx - cosine[i] * ny;
    const double d = range[i] * c - r;  // d' = t, d'' = -(d + offset)
    const double t = range[i] * s - tangential_mean;
    const double across = range[i] * range[i] * bearing_variance;
    const double w = 1.0 / (range_variance * c * c + across * s * s);
    const double v1 = 2.0 * w * s * c * (range_variance - across);            // v' / v
    const double v2 = 2.0 * w * (s * s - c * c) * (range_variance - across);  // v'' / v
    const double wd = w * d;
    const double wt = w * t;
    sums.value += wd * d;
    sums.information.xx += wt * t;
    sums.information.xy -= wt;
    sums.information.yy += w;
    sums.xx += wt * t - wd * (d + offset + 2.0 * t * v1 + d * (0.5 * v2 - v1 * v1));
    sums.xy += wd * v1 - wt;
    sums.descent_x += wd * (0.5 * d * v1 - t);
    sums.descent_y += wd;
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
  constexpr double longest_turn = 0.3;  // [rad]; Newton's steps are to be trusted near the end
  if (points.size() < 2) return FitResult::failed(FitFailure::too_few_points);
  const Moments m = moments_of(points, PointWeights::equal);
  if (!std::isfinite(m.trace())) return FitResult::failed(FitFailure::not_finite);
  if (!m.have_extent()) return FitResult::failed(FitFailure::degenerate);
  const WeightVariances variances(sensor);
  const Eigen::Vector2d mean(m.mean_x, m.mean_y);
  const double size = std::sqrt(mean.squaredNorm() + m.trace());
  State state = first_guess(m, variances);
  State accepted = state;
  double lowest = std::numeric_limits<double>::infinity();
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    const double tangential = state.normal.x() * mean.y() - state.normal.y() * mean.x();
    Derivatives sums;
    add_up(points.cosine.data(), points.sine.data(), points.range.data(), points.size(),
           state.normal.x(), state.normal.y(), state.normal.dot(mean) + state.offset, tangential,
           state.offset, variances.range, variances.bearing, sums);
    // A step that leads uphill, by more than rounding, is shortened.
    if (sums.value > lowest * (1.0 + 1e-9)) {
      step *= 0.25;
      state = accepted.moved(step);
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
    accepted = state;
    lowest = sums.value;
    state = state.moved(step);
    if (step.x() * sums.descent_x + step.y() * sums.descent_y <= small_step ||
        (std::abs(step.x()) < rounding && std::abs(step.y()) < rounding * size)) {
      const LineEstimate estimate = normalized({{direction_of(state.normal.x(), state.normal.y()),
                                                 state.normal.dot(mean) + state.offset},
                                                from_offset_at_mean(fisher->inverse, tangential)});
      FitResult result = FitResult::fitted(estimate.line, estimate.covariance);
      if (result.ok()) result.iterations = iteration;
      return result;
    }
  }
  return FitResult::failed(FitFailure::not_converged);
}

}  // namespace quoin
