// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/orthogonal.hpp"

#include <algorithm>
#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// Derivatives of (alpha, offset at the mean), still to be divided by the factors that all points
/// share.
///
/// With d and t the offsets of a point from the mean across and along the line, and dn, dt its
/// displacement by a noise: W d(offset) = w dn + w' d, and (across - along) d(alpha) = w (dn t + dt
/// d) + w' d t. Range noise displaces by (cos, sin) of the incidence angle and changes w, bearing
/// noise by (-t, d) counted from the sensor.
template <bool weighted>
inline PointJacobian jacobian_of(double cosine, double sine, double x, double y, double inverse,
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
void add_up_noise(const double* __restrict cosine, const double* __restrict sine,
                  const double* __restrict x, const double* __restrict y,
                  const double* __restrict inverse_range, std::size_t count, bool weighted,
                  double nx, double ny, double mean_x, double mean_y, double range_variance,
                  double range_growth, double bearing_variance, Symmetric2& out) {
  Symmetric2 sums;
  if (weighted) {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums,
                jacobian_of<true>(cosine[i], sine[i], x[i], y[i], inverse_range[i], nx, ny, mean_x,
                                  mean_y),
                range_variance + range_growth * (x[i] * x[i] + y[i] * y[i]), bearing_variance);
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums,
                jacobian_of<false>(cosine[i], sine[i], x[i], y[i], 1.0, nx, ny, mean_x, mean_y),
                range_variance + range_growth * (x[i] * x[i] + y[i] * y[i]), bearing_variance);
    }
  }
  out = sums;
}

}  // namespace

OrthogonalLine orthogonal_line(const CentralMoments& moments) {
  OrthogonalLine fit;
  fit.moments = moments;
  const Symmetric2& m = moments.scatter;
  const double trace = moments.trace();
  const double difference = m.xx - m.yy;
  const double spread = std::sqrt(difference * difference + 4.0 * m.xy * m.xy);
  if (!std::isfinite(spread)) {
    fit.failure = FitFailure::not_finite;
    return fit;
  }
  // Equal eigenvalues leave the direction open.
  if (!moments.have_extent() || !(spread > 1e-12 * trace)) {
    fit.failure = FitFailure::degenerate;
    return fit;
  }
  fit.along = 0.5 * (trace + spread);
  fit.across = std::max(0.0, 0.5 * (trace - spread));

  // The eigenvector of the larger eigenvalue has half the angle of (difference, 2 xy), the angle of
  // CWLF eq. (17) with the quadrant decided; its larger component comes first.
  const double cosine_twice = difference / spread;
  const double sine_twice = 2.0 * m.xy / spread;
  double cosine = std::sqrt(0.5 * (1.0 + cosine_twice));
  double sine = std::sqrt(0.5 * (1.0 - cosine_twice));
  if (cosine_twice >= 0.0) {
    sine = 0.5 * sine_twice / cosine;
  } else {
    cosine = 0.5 * sine_twice / sine;
  }
  fit.line = {-sine, cosine, moments.mean_y * cosine - moments.mean_x * sine};
  fit.failure = FitFailure::none;
  return fit;
}

OrthogonalLine orthogonal_line(const Moments& moments) {
  OrthogonalLine fit;
  if (!(moments.weight > 0.0)) return fit;
  fit = orthogonal_line(CentralMoments(moments));
  const CentralMoments& m = fit.moments;
  if (fit.ok() &&
      !(fit.along - fit.across > 1e-12 * m.weight * (m.mean_x * m.mean_x + m.mean_y * m.mean_y))) {
    fit.failure = FitFailure::degenerate;
  }
  return fit;
}

OrthogonalLine fit_orthogonal(const PointsView& points, PointWeights weights) {
  OrthogonalLine fit;
  if (points.size() < 2) {
    fit.failure = FitFailure::too_few_points;
    return fit;
  }
  fit = orthogonal_line(central_moments(points, weights));
  if (fit.line.offset < 0.0) {
    fit.line = {-fit.line.normal_x, -fit.line.normal_y, -fit.line.offset};
  }
  return fit;
}

Eigen::Matrix2d orthogonal_covariance(const PointsView& points, PointWeights weights,
                                      const OrthogonalLine& fit, const SensorModel& sensor) {
  Symmetric2 sums;
  add_up_noise(points.cosine.data(), points.sine.data(), points.x.data(), points.y.data(),
               points.inverse_range.data(), points.size(),
               weights == PointWeights::inverse_square_range, fit.line.normal_x, fit.line.normal_y,
               fit.moments.mean_x, fit.moments.mean_y, sensor.range_stddev * sensor.range_stddev,
               sensor.range_stddev_per_metre * sensor.range_stddev_per_metre,
               sensor.bearing_stddev * sensor.bearing_stddev, sums);
  const double alpha = -1.0 / (fit.along - fit.across);
  const double offset = 1.0 / fit.moments.weight;
  return from_offset_at(
      {sums.xx * alpha * alpha, sums.xy * alpha * offset, sums.yy * offset * offset},
      fit.tangential_mean());
}

Eigen::Matrix2d residual_covariance(const OrthogonalLine& fit) {
  const double variance = fit.across / (fit.moments.weight - 2.0);
  return from_offset_at({variance / fit.along, 0.0, variance / fit.moments.weight},
                        fit.tangential_mean());
}

}  // namespace quoin
