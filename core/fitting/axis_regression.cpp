// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/axis_regression.hpp"

#include <algorithm>
#include <cmath>

#include "core/fitting/moments.hpp"
#include "core/fitting/point_influence.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// The arrays of the points as abscissa u and ordinate v, with the direction of their rays.
struct Axes {
  const double* u;
  const double* v;
  const double* u_ray;
  const double* v_ray;
  double turn;  ///< 1 when v is a quarter turn counter-clockwise from u, else -1

  Axes(const PointsView& p, bool y_on_x)
      : u((y_on_x ? p.x : p.y).data()),
        v((y_on_x ? p.y : p.x).data()),
        u_ray((y_on_x ? p.cosine : p.sine).data()),
        v_ray((y_on_x ? p.sine : p.cosine).data()),
        turn(y_on_x ? 1.0 : -1.0) {}
};

/// Sums of the weighted regression about a fixed origin; the weights are those of CWLF eq. (23)
/// times both variances, so that neither needs to be positive alone.
struct Sums {
  double w = 0.0, wu = 0.0, wv = 0.0, wuu = 0.0, wuv = 0.0;
};

QUOIN_MULTIVERSION
void add_up(const double* __restrict u, const double* __restrict v, const double* __restrict u_ray,
            const double* __restrict v_ray, const double* __restrict inverse_range,
            std::size_t count, double u_origin, double v_origin, double range_variance,
            double bearing_variance, Sums& out) {
  Sums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double per_range = u_ray[i] * inverse_range[i];
    const double w =
        range_variance * per_range * per_range + bearing_variance * v_ray[i] * v_ray[i];
    const double du = u[i] - u_origin;
    const double dv = v[i] - v_origin;
    sums.w += w;
    sums.wu += w * du;
    sums.wv += w * dv;
    sums.wuu += w * du * du;
    sums.wuv += w * du * dv;
  }
  out = sums;
}

/// What the influence of a point depends on besides the point.
struct Regression {
  double slope, mean, intercept, turn, range_weight, bearing_weight;
};

/// Influences of one point on (spread * slope, weight * intercept). Normal equations: sum w e = 0
/// and sum w xi e = 0 with e the residual of v and xi = u - mean, so a point displaced by (du, dv)
/// with its weight changed by dw moves the intercept by f = w (dv - slope du) + dw e and the slope
/// by xi f + w e du.
template <bool weighted>
inline PointInfluence influence_of(double u, double v, double u_ray, double v_ray, double inverse,
                                   const Regression& fit) {
  double w = 1.0;
  double w_range = 0.0;
  double w_bearing = 0.0;
  if constexpr (weighted) {
    const double across = fit.range_weight * inverse * inverse;
    w = across * u_ray * u_ray + fit.bearing_weight * v_ray * v_ray;
    w_range = -2.0 * across * inverse * u_ray * u_ray;
    w_bearing = 2.0 * fit.turn * u_ray * v_ray * (fit.bearing_weight - across);
  }
  const double xi = u - fit.mean;
  const double e = v - fit.intercept - fit.slope * xi;
  const double range_intercept = w * (v_ray - fit.slope * u_ray) + w_range * e;
  const double bearing_intercept = w * fit.turn * (u + fit.slope * v) + w_bearing * e;
  return {xi * range_intercept + w * e * u_ray, range_intercept,
          xi * bearing_intercept - w * e * fit.turn * v, bearing_intercept};
}

QUOIN_MULTIVERSION
void add_up_influences(const double* __restrict u, const double* __restrict v,
                       const double* __restrict u_ray, const double* __restrict v_ray,
                       const double* __restrict inverse_range, std::size_t count, bool weighted,
                       Regression fit, double range_variance, double bearing_variance,
                       Symmetric2& out) {
  Symmetric2 sums;
  if (weighted) {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums, influence_of<true>(u[i], v[i], u_ray[i], v_ray[i], inverse_range[i], fit),
                range_variance, bearing_variance);
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums, influence_of<false>(u[i], v[i], u_ray[i], v_ray[i], 1.0, fit), range_variance,
                bearing_variance);
    }
  }
  out = sums;
}

/// The normal (-slope, 1) in (u, v), turned away from the sensor.
void find_normal_form(AxisRegression& fit) {
  const double norm = std::sqrt(1.0 + fit.slope * fit.slope);
  const double offset = (fit.intercept - fit.slope * fit.mean) / norm;
  fit.turned = offset < 0.0;
  const double u = fit.turned ? fit.slope : -fit.slope;
  const double v = fit.turned ? -1.0 : 1.0;
  fit.line.alpha = fit.y_on_x ? direction_of(u, v) : direction_of(v, u);
  fit.line.r = std::abs(offset);
}

}  // namespace

AxisRegression fit_axis(const PointsView& points, AxisWeights weights,
                        const WeightVariances& variances) {
  AxisRegression fit;
  const auto failed = [&fit](FitFailure reason) {
    fit.failure = reason;
    return fit;
  };
  if (points.size() < 2) return failed(FitFailure::too_few_points);
  const Moments m = moments_of(points, PointWeights::equal);
  if (!std::isfinite(m.trace())) return failed(FitFailure::not_finite);
  if (!m.have_extent()) return failed(FitFailure::degenerate);
  fit.y_on_x = m.spread.xx > m.spread.yy;
  const double u_mean = fit.y_on_x ? m.mean_x : m.mean_y;
  const double v_mean = fit.y_on_x ? m.mean_y : m.mean_x;
  if (weights == AxisWeights::equal) {
    fit.mean = u_mean;
    fit.intercept = v_mean;
    fit.weight = m.weight;
    fit.spread = std::max(m.spread.xx, m.spread.yy);
    fit.slope = m.spread.xy / fit.spread;
    const double v_spread = std::min(m.spread.xx, m.spread.yy);
    fit.residual = std::max(0.0, v_spread - fit.slope * m.spread.xy);
  } else {
    const Axes axes(points, fit.y_on_x);
    Sums sums;
    add_up(axes.u, axes.v, axes.u_ray, axes.v_ray, points.inverse_range.data(), points.size(),
           u_mean, v_mean, variances.range, variances.bearing, sums);
    const double u_shift = sums.wu / sums.w;
    const double v_shift = sums.wv / sums.w;
    fit.mean = u_mean + u_shift;
    fit.intercept = v_mean + v_shift;
    fit.weight = sums.w;
    fit.spread = sums.wuu - sums.w * u_shift * u_shift;
    fit.slope = (sums.wuv - sums.w * u_shift * v_shift) / fit.spread;
    if (!std::isfinite(fit.spread)) return failed(FitFailure::not_finite);
    // All the weight may lie on one point.
    if (!(fit.spread > 1e-18 * sums.w * (u_mean * u_mean + v_mean * v_mean))) {
      return failed(FitFailure::degenerate);
    }
  }
  find_normal_form(fit);
  return fit;
}

Symmetric2 axis_influence(const PointsView& points, AxisWeights weights, const AxisRegression& fit,
                          const SensorModel& sensor) {
  const Axes axes(points, fit.y_on_x);
  const WeightVariances variances(sensor);
  Symmetric2 sums;
  add_up_influences(
      axes.u, axes.v, axes.u_ray, axes.v_ray, points.inverse_range.data(), points.size(),
      weights == AxisWeights::conditional,
      {fit.slope, fit.mean, fit.intercept, axes.turn, variances.range, variances.bearing},
      sensor.range_stddev * sensor.range_stddev, sensor.bearing_stddev * sensor.bearing_stddev,
      sums);
  const double s = 1.0 / fit.spread;
  const double w = 1.0 / fit.weight;
  return {sums.xx * s * s, sums.xy * s * w, sums.yy * w * w};
}

Eigen::Matrix2d to_normal_form(const AxisRegression& fit, const Symmetric2& covariance) {
  const double norm_squared = 1.0 + fit.slope * fit.slope;
  const double sign = fit.turned ? -1.0 : 1.0;
  const double r_intercept = sign / std::sqrt(norm_squared);
  const double r_slope = -r_intercept * (fit.mean + fit.intercept * fit.slope) / norm_squared;
  const double alpha_slope = (fit.y_on_x ? 1.0 : -1.0) / norm_squared;
  Eigen::Matrix2d result;
  result(0, 0) = alpha_slope * alpha_slope * covariance.xx;
  result(0, 1) = alpha_slope * (r_slope * covariance.xx + r_intercept * covariance.xy);
  result(1, 0) = result(0, 1);
  result(1, 1) = r_slope * r_slope * covariance.xx + 2.0 * r_slope * r_intercept * covariance.xy +
                 r_intercept * r_intercept * covariance.yy;
  return result;
}

}  // namespace quoin
