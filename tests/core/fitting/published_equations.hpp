// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "core/sensor/points.hpp"

/// The equations of Prieto-Fernandez et al. 2026 as printed, to compare the fitters with. Slow and
/// literal on purpose.
namespace quoin::published {

/// a x + b y + c = 0 with the covariance of (a, b, c).
struct ImplicitLine {
  Eigen::Vector3d abc;
  Eigen::Matrix3d covariance;
  Eigen::Matrix<double, 3, 2> summed_jacobian;  // eq. (5), (13) with two columns
};

/// Eq. (2)-(7) with all weights 1, eq. (8)-(15) with weights 1 / (sr rho st)^2.
inline ImplicitLine implicit_line(const PointsView& p, const SensorModel& sensor, bool weighted) {
  const std::size_t n = p.size();
  double sw = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  const auto weight = [&](std::size_t i) {
    const double root = sensor.range_stddev * p.range[i] * sensor.bearing_stddev;
    return weighted ? 1.0 / (root * root) : 1.0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double w = weight(i);
    sw += w;
    sx += w * p.x[i];
    sy += w * p.y[i];
    sxx += w * p.x[i] * p.x[i];
    sxy += w * p.x[i] * p.y[i];
    syy += w * p.y[i] * p.y[i];
  }
  ImplicitLine line;
  line.abc = {sx * syy - sy * sxy, sy * sxx - sx * sxy, sxy * sxy - sxx * syy};
  line.covariance.setZero();
  line.summed_jacobian.setZero();
  const double mx = sx / sw, my = sy / sw, mxx = sxx / sw, mxy = sxy / sw, myy = syy / sw;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = p.x[i], y = p.y[i], rho = p.range[i], w = weight(i);
    Eigen::Vector3d r;
    if (weighted) {  // eq. (15a)-(15c)
      r = Eigen::Vector3d(-x * myy + y * mxy, -y * mxx + x * mxy, 0.0) * (w * sw / rho);
    } else {  // eq. (7a)-(7c)
      r = Eigen::Vector3d(x * myy + 2 * y * y * mx - y * mxy - 2 * x * y * my,
                          y * mxx + 2 * x * x * my - x * mxy - 2 * x * y * mx,
                          2 * (2 * x * y * mxy - x * x * myy - y * y * mxx)) *
          (sw / rho);
    }
    // eq. (7d)-(7f), (15d)-(15f)
    const Eigen::Vector3d s =
        Eigen::Vector3d(-y * myy + 2 * x * y * mx - x * mxy - (x * x - y * y) * my,
                        x * mxx - 2 * x * y * my + y * mxy - (x * x - y * y) * mx,
                        2 * ((x * x - y * y) * mxy + x * y * (myy - mxx))) *
        (w * sw);
    line.covariance += sensor.range_stddev * sensor.range_stddev * r * r.transpose() +
                       sensor.bearing_stddev * sensor.bearing_stddev * s * s.transpose();
    line.summed_jacobian.col(0) += r;
    line.summed_jacobian.col(1) += s;
  }
  return line;
}

/// The line of eq. (5) or (13) with a Jacobian of two columns.
inline ImplicitLine with_common_errors(ImplicitLine line, const SensorModel& sensor) {
  const Eigen::Matrix2d noise = Eigen::Vector2d(sensor.range_stddev * sensor.range_stddev,
                                                sensor.bearing_stddev * sensor.bearing_stddev)
                                    .asDiagonal();
  line.covariance = line.summed_jacobian * noise * line.summed_jacobian.transpose();
  return line;
}

/// Point Q of the inverted plane with C_Q: least squares of x_Q x - y_Q y = 1 with the weights of
/// eq. (8); differentiated numerically.
struct ConformalPoint {
  Eigen::Vector2d q;
  Eigen::Matrix2d covariance;
};
inline Eigen::Vector2d conformal_point(const PointsView& p, std::size_t moved, double d_range,
                                       double d_bearing) {
  Eigen::Matrix2d m = Eigen::Matrix2d::Zero();
  Eigen::Vector2d v = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double rho = p.range[i] + (i == moved ? d_range : 0.0);
    const double theta = p.bearing[i] + (i == moved ? d_bearing : 0.0);
    const Eigen::Vector2d row(rho * std::cos(theta), -rho * std::sin(theta));
    m += row * row.transpose() / (rho * rho);
    v += row / (rho * rho);
  }
  const double det = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  return {(m(1, 1) * v(0) - m(0, 1) * v(1)) / det, (m(0, 0) * v(1) - m(1, 0) * v(0)) / det};
}
inline ConformalPoint conformal_point(const PointsView& p, const SensorModel& sensor) {
  ConformalPoint result{conformal_point(p, 0, 0.0, 0.0), Eigen::Matrix2d::Zero()};
  const double h = 1e-5;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d g = (conformal_point(p, i, h, 0.0) - conformal_point(p, i, -h, 0.0)) /
                              (2 * h) * sensor.range_stddev;
    const Eigen::Vector2d k = (conformal_point(p, i, 0.0, h) - conformal_point(p, i, 0.0, -h)) /
                              (2 * h) * sensor.bearing_stddev;
    result.covariance += g * g.transpose() + k * k.transpose();
  }
  return result;
}

/// Eq. (16)-(23): the unit normal form and its covariance.
inline ImplicitLine normalized_line(const ConformalPoint& point) {
  const double x = point.q.x(), y = point.q.y(), norm = std::hypot(x, y);
  ImplicitLine line;
  line.abc = Eigen::Vector3d(-x, y, 1.0) / norm;
  Eigen::Matrix<double, 3, 2> j;
  j << -y * y, x * y, -x * y, x * x, -x, -y;
  j /= norm * norm * norm;
  line.covariance = j * point.covariance * j.transpose();
  line.summed_jacobian.setZero();
  return line;
}

struct PublishedCorner {
  Eigen::Vector2d position;
  Eigen::Matrix2d covariance;
};

/// Eq. (24), (25) and first-order propagation of both 3x3 covariances.
inline PublishedCorner corner(const ImplicitLine& first, const ImplicitLine& second) {
  const auto at = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) -> Eigen::Vector2d {
    const double d = u(0) * v(1) - v(0) * u(1);
    return {(u(1) * v(2) - v(1) * u(2)) / d, (v(0) * u(2) - u(0) * v(2)) / d};
  };
  const Eigen::Vector3d& u = first.abc;
  const Eigen::Vector3d& v = second.abc;
  const double d = u(0) * v(1) - v(0) * u(1);
  const Eigen::Vector2d p = at(u, v);
  Eigen::Matrix<double, 2, 3> ju;
  Eigen::Matrix<double, 2, 3> jv;
  ju << -p.x() * v(1), v(2) + p.x() * v(0), -v(1), -v(2) - p.y() * v(1), p.y() * v(0), v(0);
  jv << p.x() * u(1), -u(2) - p.x() * u(0), u(1), u(2) + p.y() * u(1), -p.y() * u(0), -u(0);
  ju /= d;
  jv /= d;
  return {p, ju * first.covariance * ju.transpose() + jv * second.covariance * jv.transpose()};
}

}  // namespace quoin::published
