// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/orthogonal.hpp"

#include <algorithm>
#include <cmath>

#include "core/fitting/offset_at_mean.hpp"
#include "core/fitting/point_influence.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// Influences of one point on (alpha, offset at the mean), still to be divided by the factors that
/// all points share.
///
/// With d and t the offsets of a point from the mean across and along the line, and dn, dt its
/// displacement by a noise: W d(offset) = w dn + w' d, and (across - along) d(alpha) = w (dn t + dt
/// d) + w' d t. Range noise displaces by (cos, sin) of the incidence angle and changes w, bearing
/// noise by (-t, d) counted from the sensor.
template <bool weighted>
inline PointInfluence influence_of(double cosine, double sine, double x, double y, double inverse,
                                   double nx, double ny, double mean_x, double mean_y) {
  const double w = inverse * inverse;
  const double w_slope = weighted ? -2.0 * w * inverse : 0.0;
  const double d = (x - mean_x) * nx + (y - mean_y) * ny;
  const double t = (y - mean_y) * nx - (x - mean_x) * ny;
  const double cos_phi = cosine * nx + sine * ny;
  const double sin_phi = sine * nx - cosine * ny;
  const double from_foot = y * nx - x * ny;
  const double from_sensor = x * nx + y * ny;
  return {w * (cos_phi * t + sin_phi * d) + w_slope * d * t, w * cos_phi + w_slope * d,
          w * (from_sensor * d - from_foot * t), -w * from_foot};
}

QUOIN_MULTIVERSION
void add_up_influences(const double* __restrict cosine, const double* __restrict sine,
                       const double* __restrict x, const double* __restrict y,
                       const double* __restrict inverse_range, std::size_t count, bool weighted,
                       double nx, double ny, double mean_x, double mean_y, double range_variance,
                       double bearing_variance, Symmetric2& out) {
  Symmetric2 sums;
  if (weighted) {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums,
                influence_of<true>(cosine[i], sine[i], x[i], y[i], inverse_range[i], nx, ny, mean_x,
                                   mean_y),
                range_variance, bearing_variance);
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums,
                influence_of<false>(cosine[i], sine[i], x[i], y[i], 1.0, nx, ny, mean_x, mean_y),
                range_variance, bearing_variance);
    }
  }
  out = sums;
}

}  // namespace

OrthogonalLine fit_orthogonal(const PointsView& points, PointWeights weights) {
  OrthogonalLine fit;
  if (points.size() < 2) {
    fit.failure = FitFailure::too_few_points;
    return fit;
  }
  fit.moments = moments_of(points, weights);
  const Symmetric2& spread = fit.moments.spread;
  const double trace = fit.moments.trace();
  const double difference = std::hypot(2.0 * spread.xy, spread.yy - spread.xx);
  if (!std::isfinite(trace)) {
    fit.failure = FitFailure::not_finite;
    return fit;
  }
  // Equal eigenvalues leave the direction open.
  if (!fit.moments.have_extent() || !(difference > 1e-12 * trace)) {
    fit.failure = FitFailure::degenerate;
    return fit;
  }
  fit.along = 0.5 * (trace + difference);
  fit.across = std::max(0.0, 0.5 * (trace - difference));
  // Direction of the eigenvector of the smaller eigenvalue: CWLF eq. (17) with both arguments of
  // the arc tangent kept, which decides the quadrant.
  const double angle = 0.5 * std::atan2(-2.0 * spread.xy, spread.yy - spread.xx);
  fit.normal_x = std::cos(angle);
  fit.normal_y = std::sin(angle);
  fit.line.r = fit.moments.mean_x * fit.normal_x + fit.moments.mean_y * fit.normal_y;
  fit.line.alpha = angle;
  if (fit.line.r < 0.0) {
    fit.normal_x = -fit.normal_x;
    fit.normal_y = -fit.normal_y;
    fit.line.r = -fit.line.r;
    fit.line.alpha = normalized_angle(angle + pi);
  }
  return fit;
}

Eigen::Matrix2d orthogonal_covariance(const PointsView& points, PointWeights weights,
                                      const OrthogonalLine& fit, double range_variance,
                                      double bearing_variance) {
  Symmetric2 sums;
  add_up_influences(points.cosine.data(), points.sine.data(), points.x.data(), points.y.data(),
                    points.inverse_range.data(), points.size(),
                    weights == PointWeights::inverse_square_range, fit.normal_x, fit.normal_y,
                    fit.moments.mean_x, fit.moments.mean_y, range_variance, bearing_variance, sums);
  const double alpha = -1.0 / (fit.along - fit.across);
  const double offset = 1.0 / fit.moments.weight;
  return from_offset_at_mean(
      {sums.xx * alpha * alpha, sums.xy * alpha * offset, sums.yy * offset * offset},
      fit.tangential_mean());
}

}  // namespace quoin
