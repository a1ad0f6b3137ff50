// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/likelihood_fitters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

// Where a ray runs along the line, the range at which it meets it is limited; noise along the ray
// is of no effect there.
constexpr double smallest_cosine = 0.03;

/// Variance of the range at which a ray meets a line, where it grows with the range.
struct GrowingVariance {
  NormalLine met;
  double growth = 0.0;
};

template <bool second_derivatives, bool growing>
[[gnu::always_inline]] inline void add_up(
    const double* __restrict cosine, const double* __restrict sine, const double* __restrict range,
    std::size_t count, double nx, double ny, double r, double t_anchor, double offset,
    double fixed_variance, GrowingVariance more, double bearing_variance, NormalResiduals& out) {
  NormalResiduals sums;
  double gradient_x = 0.0;
  double gradient_y = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i] * nx + sine[i] * ny;
    const double s = sine[i] * nx - cosine[i] * ny;
    const double d = range[i] * c - r;  // d' = t, d'' = -(d + offset)
    const double t = range[i] * s - t_anchor;
    const double across = range[i] * range[i] * bearing_variance;
    double range_variance = fixed_variance;
    if constexpr (growing) {
      const double cos_phi = cosine[i] * more.met.normal_x + sine[i] * more.met.normal_y;
      const double met =
          more.met.offset / (std::abs(cos_phi) > smallest_cosine ? cos_phi : smallest_cosine);
      range_variance += more.growth * met * met;
    }
    const double w = 1.0 / (range_variance * c * c + across * s * s);
    const double half_v1 = w * s * c * (range_variance - across);  // v' / 2 v
    const double wd = w * d;
    // Coordinate along the line of the true point, estimated from how far the measured one is off.
    const double t_true = t - d * half_v1;
    sums.value += wd * d;
    sums.information.xx += w * t_true * t_true;
    sums.information.xy -= w * t_true;
    sums.information.yy += w;
    sums.noise_along += w * w * range_variance * across;
    gradient_x += wd * t_true;
    gradient_y -= wd;
    if constexpr (second_derivatives) {
      const double v1 = 2.0 * half_v1;
      const double v2 = 2.0 * w * (s * s - c * c) * (range_variance - across);  // v'' / v
      const double wt = w * t;
      sums.hessian_xx += wt * t - wd * (d + offset + 2.0 * t * v1 + d * (0.5 * v2 - v1 * v1));
      sums.hessian_xy += wd * v1 - wt;
    }
  }
  sums.gradient = {gradient_x, gradient_y};
  out = sums;
}

QUOIN_MULTIVERSION
void add_up_first(const double* cosine, const double* sine, const double* range, std::size_t count,
                  double nx, double ny, double r, double t_anchor, double range_variance,
                  double bearing_variance, NormalResiduals& out) {
  add_up<false, false>(cosine, sine, range, count, nx, ny, r, t_anchor, 0.0, range_variance, {},
                       bearing_variance, out);
}

QUOIN_MULTIVERSION
void add_up_first_growing(const double* cosine, const double* sine, const double* range,
                          std::size_t count, double nx, double ny, double r, double t_anchor,
                          double range_variance, GrowingVariance more, double bearing_variance,
                          NormalResiduals& out) {
  add_up<false, true>(cosine, sine, range, count, nx, ny, r, t_anchor, 0.0, range_variance, more,
                      bearing_variance, out);
}

QUOIN_MULTIVERSION
void add_up_second(const double* cosine, const double* sine, const double* range, std::size_t count,
                   double nx, double ny, double r, double t_anchor, double offset,
                   double range_variance, double bearing_variance, NormalResiduals& out) {
  add_up<true, false>(cosine, sine, range, count, nx, ny, r, t_anchor, offset, range_variance, {},
                      bearing_variance, out);
}

QUOIN_MULTIVERSION
void add_up_second_growing(const double* cosine, const double* sine, const double* range,
                           std::size_t count, double nx, double ny, double r, double t_anchor,
                           double offset, double range_variance, GrowingVariance more,
                           double bearing_variance, NormalResiduals& out) {
  add_up<true, true>(cosine, sine, range, count, nx, ny, r, t_anchor, offset, range_variance, more,
                     bearing_variance, out);
}

}  // namespace

NormalLine moved(const NormalLine& line, const Eigen::Vector2d& anchor,
                 const Eigen::Vector2d& step) {
  const double c = std::cos(step.x());
  const double s = std::sin(step.x());
  NormalLine result{c * line.normal_x - s * line.normal_y, s * line.normal_x + c * line.normal_y};
  // The distance of the anchor changes by the second step alone.
  result.offset =
      result.distance(anchor.x(), anchor.y()) - line.distance(anchor.x(), anchor.y()) + step.y();
  return result;
}

NormalResiduals normal_residuals(const PointsView& points, const NormalLine& line,
                                 const Eigen::Vector2d& anchor, const WeightVariances& variances,
                                 const NormalLine& variance_line) {
  NormalResiduals sums;
  const double t_anchor = line.along(anchor.x(), anchor.y());
  if (variances.range_growth > 0.0) {
    add_up_first_growing(points.cosine.data(), points.sine.data(), points.range.data(),
                         points.size(), line.normal_x, line.normal_y, line.offset, t_anchor,
                         variances.range, {variance_line, variances.range_growth},
                         variances.bearing, sums);
  } else {
    add_up_first(points.cosine.data(), points.sine.data(), points.range.data(), points.size(),
                 line.normal_x, line.normal_y, line.offset, t_anchor, variances.range,
                 variances.bearing, sums);
  }
  return sums;
}

NormalResiduals normal_residuals_with_hessian(const PointsView& points, const NormalLine& line,
                                              const Eigen::Vector2d& anchor,
                                              const WeightVariances& variances,
                                              const NormalLine& variance_line) {
  NormalResiduals sums;
  const double t_anchor = line.along(anchor.x(), anchor.y());
  const double offset = -line.distance(anchor.x(), anchor.y());
  if (variances.range_growth > 0.0) {
    add_up_second_growing(points.cosine.data(), points.sine.data(), points.range.data(),
                          points.size(), line.normal_x, line.normal_y, line.offset, t_anchor,
                          offset, variances.range, {variance_line, variances.range_growth},
                          variances.bearing, sums);
  } else {
    add_up_second(points.cosine.data(), points.sine.data(), points.range.data(), points.size(),
                  line.normal_x, line.normal_y, line.offset, t_anchor, offset, variances.range,
                  variances.bearing, sums);
  }
  return sums;
}

FitResult fitted(const NormalLine& line, const Eigen::Vector2d& anchor,
                 const NormalResiduals& residuals) {
  // Few points within their own noise would lose all of their spread.
  constexpr double most = 0.5;
  Symmetric2 information = residuals.information;
  const double spread = information.xx - information.xy * information.xy / information.yy;
  information.xx -= std::min(residuals.noise_along, most * spread);
  const auto solution = solve2x2(information, Eigen::Vector2d::Zero());
  if (!solution) return FitResult::failed(FitFailure::degenerate);
  const LineEstimate estimate =
      normalized({{direction_of(line.normal_x, line.normal_y), line.offset},
                  from_offset_at(solution->inverse, line.along(anchor.x(), anchor.y()))});
  return FitResult::fitted(estimate.line, estimate.covariance);
}

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
