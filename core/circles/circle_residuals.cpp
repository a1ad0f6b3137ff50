// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/circle_residuals.hpp"

#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// A point as a circle sees it, at its measured place.
struct Incidence {
  double normal_x, normal_y;  // from the centre to the point
  double from_center;         // [m]
  double cosine, sine;        // of the angle from the normal to the ray
  double range_variance;      // [m^2]
  double across_variance;     // [m^2] of the noise of the bearing
};

[[gnu::always_inline]] inline Incidence incidence(double x, double y, double cosine, double sine,
                                                  double range, const Circle& circle,
                                                  const WeightVariances& variances) {
  const double dx = x - circle.center.x();
  const double dy = y - circle.center.y();
  const double distance = std::sqrt(dx * dx + dy * dy);
  const double scale = 1.0 / distance;
  const double nx = dx * scale;
  const double ny = dy * scale;
  const double square = range * range;
  return {nx,
          ny,
          distance,
          nx * cosine + ny * sine,
          nx * sine - ny * cosine,
          variances.range_at(square),
          variances.bearing * square};
}

QUOIN_MULTIVERSION
void add_up(const double* __restrict x, const double* __restrict y, const double* __restrict cosine,
            const double* __restrict sine, const double* __restrict range, std::size_t count,
            const Circle& circle, const WeightVariances& variances, CircleSums& out) {
  const Circle c = circle;
  const WeightVariances noise = variances;
  const double curvature = 1.0 / c.radius;
  const double half_curvature = 0.5 * curvature;
  const double second_order = 1.5 * curvature * curvature;
  CircleSums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const Incidence p = incidence(x[i], y[i], cosine[i], sine[i], range[i], c, noise);
    const double cc = p.cosine * p.cosine;
    const double ss = p.sine * p.sine;
    const double u = p.range_variance * ss + p.across_variance * cc;
    const double v = p.range_variance * cc + p.across_variance * ss + second_order * u * u;
    const double d = p.from_center - c.radius - half_curvature * u;
    // To the foot: along the circle, in range, and the change of the incidence angle.
    const double pull = d / v;
    const double along =
        -pull * (p.range_variance - p.across_variance) * p.sine * p.cosine * curvature;  // [rad]
    const double r = range[i] - pull * p.range_variance * p.cosine;
    const double turn = pull * noise.bearing * range[i] * p.sine - along;
    const double foot_cosine = p.cosine - p.sine * turn;
    const double foot_sine = p.sine + p.cosine * turn;
    const double foot_cc = foot_cosine * foot_cosine;
    const double foot_ss = foot_sine * foot_sine;
    const double range_variance = noise.range_at(r * r);
    const double across_variance = noise.bearing * r * r;
    const double foot_u = range_variance * foot_ss + across_variance * foot_cc;
    const double w = 1.0 / (range_variance * foot_cc + across_variance * foot_ss +
                            second_order * foot_u * foot_u);
    const double gx = p.normal_x - p.normal_y * along;
    const double gy = p.normal_y + p.normal_x * along;
    const double wx = w * gx;
    const double wy = w * gy;
    const double wd = w * d;
    const double wxx = wx * gx;
    sums.xx += wxx;
    sums.xy += wx * gy;
    sums.yy += wy * gy;
    sums.x += wx;
    sums.y += wy;
    sums.one += w;
    sums.distance_x += wd * gx;
    sums.distance_y += wd * gy;
    sums.distance += wd;
    sums.xxx += wxx * gx;
    sums.xxy += wxx * gy;
    sums.chi_square += wd * d;
    sums.along += foot_u;
  }
  out = sums;
}

/// Sums of g g^T, of v g g^T and of what makes the bias.
struct EqualSums {
  CircleSums plain;
  CircleSums noisy;
  double bias_x = 0.0, bias_y = 0.0, bias_radius = 0.0;
};

QUOIN_MULTIVERSION
void add_up_equal(const double* __restrict x, const double* __restrict y,
                  const double* __restrict cosine, const double* __restrict sine,
                  const double* __restrict range, std::size_t count, const Circle& circle,
                  const WeightVariances& variances, EqualSums& out) {
  const Circle c = circle;
  const WeightVariances noise = variances;
  const double second_order = 0.5 / (c.radius * c.radius);
  CircleSums h;
  CircleSums m;
  double bias_x = 0.0;
  double bias_y = 0.0;
  double bias_radius = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Incidence p = incidence(x[i], y[i], cosine[i], sine[i], range[i], c, noise);
    const double cc = p.cosine * p.cosine;
    const double ss = p.sine * p.sine;
    const double u = p.range_variance * ss + p.across_variance * cc;
    const double first = p.range_variance * cc + p.across_variance * ss;
    const double v = first + second_order * u * u;
    const double mixed = (p.range_variance - p.across_variance) * p.sine * p.cosine;
    const double normal = 0.5 * (3.0 * first + u);
    const double xx = p.normal_x * p.normal_x;
    const double xy = p.normal_x * p.normal_y;
    const double yy = p.normal_y * p.normal_y;
    h.xx += xx;
    h.xy += xy;
    h.yy += yy;
    h.x += p.normal_x;
    h.y += p.normal_y;
    m.xx += v * xx;
    m.xy += v * xy;
    m.yy += v * yy;
    m.x += v * p.normal_x;
    m.y += v * p.normal_y;
    m.one += v;
    bias_x += normal * p.normal_x - mixed * p.normal_y;
    bias_y += normal * p.normal_y + mixed * p.normal_x;
    bias_radius += 0.5 * (first + u);
  }
  h.one = static_cast<double>(count);
  out = {h, m, bias_x, bias_y, bias_radius};
}

}  // namespace

CircleSums circle_sums(const PointsView& points, const Circle& circle,
                       const WeightVariances& variances) {
  CircleSums sums;
  add_up(points.x.data(), points.y.data(), points.cosine.data(), points.sine.data(),
         points.range.data(), points.size(), circle, variances, sums);
  return sums;
}

std::optional<Eigen::Matrix3d> inverse_of(const Eigen::Matrix3d& matrix) {
  constexpr double rounding = 1e-12;  // an arc of 0.05 rad is above
  const double a = matrix(0, 0), b = matrix(0, 1), c = matrix(0, 2);
  const double d = matrix(1, 1), e = matrix(1, 2), f = matrix(2, 2);
  const double df = d * f - e * e;
  const double cross = c * e - b * f;
  const double last = b * e - c * d;
  const double determinant = a * df + b * cross + c * last;
  const double trace = a + d + f;
  if (!(determinant > rounding * trace * trace * trace)) return std::nullopt;
  const double scale = 1.0 / determinant;
  const double ac = a * f - c * c;
  const double mixed = b * c - a * e;
  const double ad = a * d - b * b;
  return Eigen::Matrix3d{{scale * df, scale * cross, scale * last},
                         {scale * cross, scale * ac, scale * mixed},
                         {scale * last, scale * mixed, scale * ad}};
}

std::optional<EqualWeights> equal_weights(const PointsView& points, const Circle& circle,
                                          const WeightVariances& variances) {
  EqualSums sums;
  add_up_equal(points.x.data(), points.y.data(), points.cosine.data(), points.sine.data(),
               points.range.data(), points.size(), circle, variances, sums);
  const auto inverse = inverse_of(sums.plain.information());
  if (!inverse) return std::nullopt;
  const Eigen::Matrix3d by_radius = *inverse / circle.radius;
  const double mean = sums.noisy.one / sums.plain.one;
  return EqualWeights{*inverse * sums.noisy.information() * *inverse,
                      by_radius * Eigen::Vector3d(sums.bias_x, sums.bias_y, sums.bias_radius),
                      mean * (by_radius * Eigen::Vector3d(sums.plain.x, sums.plain.y, 0.0)),
                      sums.noisy.one * by_radius.col(2)};
}

void add_range_bias(const PointsView& points, const SensorModel& sensor, bool weighted,
                    CircleEstimate& estimate) {
  const double bias = sensor.range_bias_stddev;
  if (!(bias > 0.0)) return;
  const WeightVariances variances(sensor);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d effect = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Incidence p = incidence(points.x[i], points.y[i], points.cosine[i], points.sine[i],
                                  points.range[i], estimate.circle, variances);
    const double v = p.range_variance * p.cosine * p.cosine + p.across_variance * p.sine * p.sine;
    const double weight = weighted ? 1.0 / v : 1.0;
    const Eigen::Vector3d gradient(p.normal_x, p.normal_y, 1.0);
    information += weight * gradient * gradient.transpose();
    effect += weight * p.cosine * gradient;
  }
  const auto inverse = inverse_of(information);
  if (!inverse) return;
  const Eigen::Vector3d shift = bias * (*inverse * effect);
  estimate.covariance += shift * shift.transpose();
}

CircleFit judged(const CircleEstimate& estimate, const CircleSums& sums, std::size_t points,
                 const CircleParameters& parameters) {
  const Circle& circle = estimate.circle;
  if (!circle.center.allFinite() || !std::isfinite(circle.radius) ||
      !estimate.covariance.allFinite()) {
    return CircleFit::failed(CircleFailure::not_finite);
  }
  CircleFit fit;
  fit.estimate = estimate;
  fit.chi_square = sums.chi_square;
  const double variance =
      std::max(estimate.covariance(2, 2), sums.along / static_cast<double>(points));
  fit.nonlinearity = std::sqrt(variance) / circle.radius;
  if (!(circle.radius > 0.0) || !(fit.nonlinearity <= parameters.max_nonlinearity)) {
    return CircleFit::failed(CircleFailure::not_determined);
  }
  return fit;
}

}  // namespace quoin
