// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/axis_regression.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Moments about a fixed origin; the weights are those of CWLF eq. (23) times both variances, so
/// that neither needs to be positive alone.
QUOIN_MULTIVERSION
void add_up(const double* __restrict u, const double* __restrict v, const double* __restrict u_ray,
            const double* __restrict v_ray, const double* __restrict inverse_range,
            std::size_t count, double u_origin, double v_origin, double range_variance,
            double bearing_variance, Moments& out) {
  Moments sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double per_range = u_ray[i] * inverse_range[i];
    const double w =
        range_variance * per_range * per_range + bearing_variance * v_ray[i] * v_ray[i];
    sums.add(u[i] - u_origin, v[i] - v_origin, w);
  }
  out = sums;
}

/// What the derivatives depend on besides the point.
struct Regression {
  double slope, mean, intercept, turn, range_weight, bearing_weight;
};

/// Derivatives of (spread * slope, weight * intercept). Normal equations: sum w e = 0
/// and sum w xi e = 0 with e the residual of v and xi = u - mean, so a point displaced by (du, dv)
/// with its weight changed by dw moves the intercept by f = w (dv - slope du) + dw e and the slope
/// by xi f + w e du.
template <bool weighted>
inline PointJacobian jacobian_of(double u, double v, double u_ray, double v_ray, double inverse,
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
void add_up_noise(const double* __restrict u, const double* __restrict v,
                  const double* __restrict u_ray, const double* __restrict v_ray,
                  const double* __restrict inverse_range, std::size_t count, bool weighted,
                  Regression fit, double range_variance, double range_growth,
                  double bearing_variance, Symmetric2& out) {
  Symmetric2 sums;
  if (weighted) {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums, jacobian_of<true>(u[i], v[i], u_ray[i], v_ray[i], inverse_range[i], fit),
                range_variance + range_growth * (u[i] * u[i] + v[i] * v[i]), bearing_variance);
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      add_noise(sums, jacobian_of<false>(u[i], v[i], u_ray[i], v_ray[i], 1.0, fit),
                range_variance + range_growth * (u[i] * u[i] + v[i] * v[i]), bearing_variance);
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
  CentralMoments m = central_moments(points, PointWeights::equal);
  if (!std::isfinite(m.trace())) return failed(FitFailure::not_finite);
  if (!m.have_extent()) return failed(FitFailure::degenerate);
  fit.y_on_x = m.scatter.xx > m.scatter.yy;
  if (!fit.y_on_x) {
    std::swap(m.mean_x, m.mean_y);
    std::swap(m.scatter.xx, m.scatter.yy);
  }
  if (weights == AxisWeights::conditional) {
    const Axes axes(points, fit.y_on_x);
    Moments sums;
    add_up(axes.u, axes.v, axes.u_ray, axes.v_ray, points.inverse_range.data(), points.size(),
           m.mean_x, m.mean_y, variances.range, variances.bearing, sums);
    const double square = m.mean_x * m.mean_x + m.mean_y * m.mean_y;
    m = CentralMoments(sums, m.mean_x, m.mean_y);
    if (!std::isfinite(m.scatter.xx)) return failed(FitFailure::not_finite);
    // All the weight may lie on one point.
    if (!(m.scatter.xx > 1e-18 * m.weight * square)) return failed(FitFailure::degenerate);
  }
  fit.mean = m.mean_x;
  fit.intercept = m.mean_y;
  fit.weight = m.weight;
  fit.spread = m.scatter.xx;
  fit.slope = m.scatter.xy / fit.spread;
  fit.residual = std::max(0.0, m.scatter.yy - fit.slope * m.scatter.xy);
  find_normal_form(fit);
  return fit;
}

Symmetric2 axis_covariance(const PointsView& points, AxisWeights weights, const AxisRegression& fit,
                           const SensorModel& sensor) {
  const Axes axes(points, fit.y_on_x);
  const WeightVariances variances = WeightVariances::of_middle(sensor, points);
  Symmetric2 sums;
  add_up_noise(axes.u, axes.v, axes.u_ray, axes.v_ray, points.inverse_range.data(), points.size(),
               weights == AxisWeights::conditional,
               {fit.slope, fit.mean, fit.intercept, axes.turn, variances.range, variances.bearing},
               sensor.range_stddev * sensor.range_stddev,
               sensor.range_stddev_per_metre * sensor.range_stddev_per_metre,
               sensor.bearing_stddev * sensor.bearing_stddev, sums);
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
