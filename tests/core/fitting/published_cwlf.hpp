// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "core/sensor/points.hpp"

/// The equations of Prieto-Fernandez et al. 2024 as printed (misprints corrected where noted), to
/// compare the fitters with. Slow and literal on purpose.
namespace quoin::published {

/// y = m (x - x_mean) + b, or x = s (y - y_mean) + h when not `y_on_x`.
struct AxisLine {
  bool y_on_x = true;
  double slope = 0.0;  ///< m or s
  double mean = 0.0;
  double intercept = 0.0;  ///< b or h
  double slope_variance = 0.0;
  double intercept_variance = 0.0;
};

/// Eq. (10), (13), (15), (20)-(35). Eq. (31) with w_i xi_i in the numerator instead of its sum.
inline AxisLine conditional_line(const PointsView& p, const SensorModel& sensor) {
  const auto n = static_cast<double>(p.size());
  double rx = 0, ry = 0, rxx = 0, ryy = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    rx += p.x[i];
    ry += p.y[i];
    rxx += p.x[i] * p.x[i];
    ryy += p.y[i] * p.y[i];
  }
  AxisLine line;
  line.y_on_x = rxx * n - rx * rx > ryy * n - ry * ry;
  const auto u = line.y_on_x ? p.x : p.y;
  const auto v = line.y_on_x ? p.y : p.x;
  const auto conditional_variance = [&](std::size_t i) {
    const double vr = sensor.range_stddev * sensor.range_stddev;
    const double vt = p.range[i] * p.range[i] * sensor.bearing_stddev * sensor.bearing_stddev;
    const double along_u = line.y_on_x ? std::cos(p.bearing[i]) : std::sin(p.bearing[i]);
    const double along_v = line.y_on_x ? std::sin(p.bearing[i]) : std::cos(p.bearing[i]);
    return vr * vt / (vr * along_u * along_u + vt * along_v * along_v);
  };
  double w_sum = 0, wu = 0, wv = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double w = 1.0 / conditional_variance(i);
    w_sum += w;
    wu += w * u[i];
    wv += w * v[i];
  }
  line.mean = wu / w_sum;
  line.intercept = wv / w_sum;
  double wxv = 0, wxx = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double w = 1.0 / conditional_variance(i);
    const double xi = u[i] - line.mean;
    wxv += w * xi * v[i];
    wxx += w * xi * xi;
  }
  line.slope = wxv / wxx;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double variance = conditional_variance(i);
    const double of_slope = (u[i] - line.mean) / variance / wxx;
    const double of_intercept = 1.0 / variance / w_sum;
    line.slope_variance += of_slope * of_slope * variance;
    line.intercept_variance += of_intercept * of_intercept * variance;
  }
  return line;
}

/// Eq. (40) and (41), (43) and (44), (46) and (47).
inline Eigen::Vector2d corner_of(const AxisLine& j, const AxisLine& k) {
  if (j.y_on_x && k.y_on_x) {
    return {
        (k.slope * k.mean - j.slope * j.mean + j.intercept - k.intercept) / (k.slope - j.slope),
        (j.slope * k.slope * (k.mean - j.mean) + k.slope * j.intercept - j.slope * k.intercept) /
            (k.slope - j.slope)};
  }
  if (!j.y_on_x && !k.y_on_x) {
    return {
        (j.slope * k.slope * (k.mean - j.mean) + k.slope * j.intercept - j.slope * k.intercept) /
            (k.slope - j.slope),
        (k.slope * k.mean - j.slope * j.mean + j.intercept - k.intercept) / (k.slope - j.slope)};
  }
  const AxisLine& on_x = j.y_on_x ? j : k;
  const AxisLine& on_y = j.y_on_x ? k : j;
  const double m = on_x.slope, b = on_x.intercept, s = on_y.slope, h = on_y.intercept;
  return {(-m * s * on_x.mean + s * b - s * on_y.mean + h) / (1.0 - m * s),
          (-m * s * on_y.mean + m * h - m * on_x.mean + b) / (1.0 - m * s)};
}

struct AxisCorner {
  Eigen::Vector2d position;
  Eigen::Matrix2d covariance;
};

/// Eq. (42), (45), (48); the Jacobian, which is not printed, by central differences.
inline AxisCorner corner(const AxisLine& first, const AxisLine& second) {
  AxisCorner result{corner_of(first, second), Eigen::Matrix2d::Zero()};
  const double h = 1e-6;
  const auto add = [&](double AxisLine::*parameter, double AxisLine::*variance, bool of_first) {
    AxisLine lower[2] = {first, second};
    AxisLine upper[2] = {first, second};
    const std::size_t moved = of_first ? 0 : 1;
    lower[moved].*parameter -= h;
    upper[moved].*parameter += h;
    const Eigen::Vector2d derivative =
        (corner_of(upper[0], upper[1]) - corner_of(lower[0], lower[1])) / (2.0 * h);
    result.covariance +=
        derivative * derivative.transpose() * ((of_first ? first : second).*variance);
  };
  for (const bool of_first : {true, false}) {
    add(&AxisLine::slope, &AxisLine::slope_variance, of_first);
    add(&AxisLine::intercept, &AxisLine::intercept_variance, of_first);
  }
  return result;
}

}  // namespace quoin::published
