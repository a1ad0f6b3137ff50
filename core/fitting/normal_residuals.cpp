// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/normal_residuals.hpp"

#include <algorithm>
#include <cmath>

#include "core/fitting/offset_at_mean.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

template <bool second_derivatives>
[[gnu::always_inline]] inline void add_up(const double* __restrict cosine,
                                          const double* __restrict sine,
                                          const double* __restrict range, std::size_t count,
                                          double nx, double ny, double r, double tangential_anchor,
                                          double offset, double range_variance,
                                          double bearing_variance, NormalResiduals& out) {
  NormalResiduals sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i] * nx + sine[i] * ny;
    const double s = sine[i] * nx - cosine[i] * ny;
    const double d = range[i] * c - r;  // d' = t, d'' = -(d + offset)
    const double t = range[i] * s - tangential_anchor;
    const double across = range[i] * range[i] * bearing_variance;
    const double w = 1.0 / (range_variance * c * c + across * s * s);
    const double half_v1 = w * s * c * (range_variance - across);  // v' / 2 v
    const double wd = w * d;
    // Where the point was along the line, given how far it is off.
    const double place = t - d * half_v1;
    sums.value += wd * d;
    sums.information.xx += w * place * place;
    sums.information.xy -= w * place;
    sums.information.yy += w;
    sums.scatter += w * w * range_variance * across;
    sums.descent_x -= wd * place;
    sums.descent_y += wd;
    if constexpr (second_derivatives) {
      const double v1 = 2.0 * half_v1;
      const double v2 = 2.0 * w * (s * s - c * c) * (range_variance - across);  // v'' / v
      const double wt = w * t;
      sums.xx += wt * t - wd * (d + offset + 2.0 * t * v1 + d * (0.5 * v2 - v1 * v1));
      sums.xy += wd * v1 - wt;
    }
  }
  out = sums;
}

QUOIN_MULTIVERSION
void add_up_first(const double* cosine, const double* sine, const double* range, std::size_t count,
                  double nx, double ny, double r, double tangential_anchor, double range_variance,
                  double bearing_variance, NormalResiduals& out) {
  add_up<false>(cosine, sine, range, count, nx, ny, r, tangential_anchor, 0.0, range_variance,
                bearing_variance, out);
}

QUOIN_MULTIVERSION
void add_up_second(const double* cosine, const double* sine, const double* range, std::size_t count,
                   double nx, double ny, double r, double tangential_anchor, double offset,
                   double range_variance, double bearing_variance, NormalResiduals& out) {
  add_up<true>(cosine, sine, range, count, nx, ny, r, tangential_anchor, offset, range_variance,
               bearing_variance, out);
}

}  // namespace

AnchoredLine AnchoredLine::moved(const Eigen::Vector2d& step) const {
  const double c = std::cos(step.x());
  const double s = std::sin(step.x());
  return {anchor,
          {c * normal.x() - s * normal.y(), s * normal.x() + c * normal.y()},
          offset + step.y()};
}

NormalResiduals normal_residuals(const PointsView& points, const AnchoredLine& line,
                                 const WeightVariances& variances) {
  NormalResiduals sums;
  add_up_first(points.cosine.data(), points.sine.data(), points.range.data(), points.size(),
               line.normal.x(), line.normal.y(), line.r(), line.tangential(), variances.range,
               variances.bearing, sums);
  return sums;
}

NormalResiduals normal_residuals_with_curvature(const PointsView& points, const AnchoredLine& line,
                                                const WeightVariances& variances) {
  NormalResiduals sums;
  add_up_second(points.cosine.data(), points.sine.data(), points.range.data(), points.size(),
                line.normal.x(), line.normal.y(), line.r(), line.tangential(), line.offset,
                variances.range, variances.bearing, sums);
  return sums;
}

FitResult fitted(const AnchoredLine& line, const NormalResiduals& residuals) {
  // Few points within their own noise would lose all of their spread.
  constexpr double most = 0.5;
  Symmetric2 information = residuals.information;
  const double spread = information.xx - information.xy * information.xy / information.yy;
  information.xx -= std::min(residuals.scatter, most * spread);
  const auto inverse = solve_inverse_line(information, 0.0, 0.0);
  if (!inverse) return FitResult::failed(FitFailure::degenerate);
  const LineEstimate estimate =
      normalized({{direction_of(line.normal.x(), line.normal.y()), line.r()},
                  from_offset_at_mean(inverse->inverse, line.tangential())});
  return FitResult::fitted(estimate.line, estimate.covariance);
}

}  // namespace quoin
