// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/circle.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "core/fitting/point_sums.hpp"
#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr int newton_steps = 20;
constexpr int gauss_newton_steps = 3;

/// About the mean of the points, each divided by their number; z = x^2 + y^2.
struct CircleMoments {
  double mean_x = 0.0, mean_y = 0.0;
  double xx = 0.0, yy = 0.0, xy = 0.0, xz = 0.0, yz = 0.0, zz = 0.0;
};

CircleMoments moments_of(const PointsView& points) {
  CircleMoments m;
  const auto scale = 1.0 / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    m.mean_x += points.x[i] * scale;
    m.mean_y += points.y[i] * scale;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x[i] - m.mean_x;
    const double y = points.y[i] - m.mean_y;
    const double z = x * x + y * y;
    m.xx += x * x * scale;
    m.yy += y * y * scale;
    m.xy += x * y * scale;
    m.xz += x * z * scale;
    m.yz += y * z * scale;
    m.zz += z * z * scale;
  }
  return m;
}

/// Taubin, "Estimation of planar curves, surfaces, and nonplanar space curves defined by implicit
/// equations", 1991: the smallest root of the characteristic polynomial by Newton's method from 0,
/// which is below it.
std::optional<Circle> taubin(const CircleMoments& m) {
  const double z = m.xx + m.yy;
  const double determinant = m.xx * m.yy - m.xy * m.xy;
  const double variance_z = m.zz - z * z;
  const double a3 = 4.0 * z;
  const double a2 = -3.0 * z * z - m.zz;
  const double a1 = variance_z * z + 4.0 * determinant * z - m.xz * m.xz - m.yz * m.yz;
  const double a0 = m.xz * (m.xz * m.yy - m.yz * m.xy) + m.yz * (m.yz * m.xx - m.xz * m.xy) -
                    variance_z * determinant;
  double root = 0.0;
  for (int k = 0; k < newton_steps; ++k) {
    const double value = a0 + root * (a1 + root * (a2 + root * a3));
    const double slope = a1 + root * (2.0 * a2 + root * 3.0 * a3);
    const double next = root - value / slope;
    if (!std::isfinite(next) || next == root) break;
    root = next;
  }
  const double scale = 2.0 * (root * root - root * z + determinant);
  const Eigen::Vector2d center((m.xz * (m.yy - root) - m.yz * m.xy) / scale,
                               (m.yz * (m.xx - root) - m.xz * m.xy) / scale);
  const double radius = std::sqrt(center.squaredNorm() + z);
  if (!center.allFinite() || !std::isfinite(radius)) return std::nullopt;
  return Circle{center + Eigen::Vector2d(m.mean_x, m.mean_y), radius};
}

/// A point as a circle sees it.
struct Residual {
  double normal_x, normal_y;  // from the centre to the point
  double distance;            // [m] from the circle, positive outside
  double variance;            // [m^2] of the noise across the circle
};

Residual residual_of(const Circle& circle, const PointsView& points, std::size_t i,
                     const WeightVariances& variances) {
  const double dx = points.x[i] - circle.center.x();
  const double dy = points.y[i] - circle.center.y();
  const double from_center = std::sqrt(dx * dx + dy * dy);
  const double scale = from_center > 0.0 ? 1.0 / from_center : 0.0;
  const double nx = dx * scale;
  const double ny = dy * scale;
  const double cosine = nx * points.cosine[i] + ny * points.sine[i];
  const double across = nx * points.y[i] - ny * points.x[i];
  return {nx, ny, from_center - circle.radius,
          variances.range_at(points.range[i] * points.range[i]) * cosine * cosine +
              variances.bearing * across * across};
}

/// One step; false when the points do not determine it.
bool improve(Circle& circle, const PointsView& points, const WeightVariances& variances) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Residual residual = residual_of(circle, points, i, variances);
    const Eigen::Vector3d row(residual.normal_x, residual.normal_y, 1.0);
    const double weight = 1.0 / residual.variance;
    information += weight * row * row.transpose();
    gradient += weight * residual.distance * row;
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(information);
  if (solver.info() != Eigen::Success) return false;
  const Eigen::Vector3d step = solver.solve(gradient);
  if (!step.allFinite()) return false;
  circle.center += step.head<2>();
  circle.radius += step.z();
  return circle.radius > 0.0;
}

}  // namespace

std::optional<Circle> fit_circle(const PointsView& points, const SensorModel& sensor) {
  if (points.size() < 3) return std::nullopt;
  std::optional<Circle> circle = taubin(moments_of(points));
  const WeightVariances variances(sensor);
  for (int k = 0; k < gauss_newton_steps && circle; ++k) {
    if (!improve(*circle, points, variances)) circle.reset();
  }
  return circle;
}

double chi_square(const Circle& circle, const PointsView& points, const SensorModel& sensor,
                  double variance_floor) {
  const WeightVariances variances(sensor);
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Residual residual = residual_of(circle, points, i, variances);
    sum += residual.distance * residual.distance / (residual.variance + variance_floor);
  }
  return sum;
}

double covered_angle(const Circle& circle, const PointsView& points) {
  if (points.size() < 2) return 0.0;
  const auto direction = [&](std::size_t i) {
    return std::atan2(points.y[i] - circle.center.y(), points.x[i] - circle.center.x());
  };
  const double first = direction(0);
  const double middle = direction(points.size() / 2);
  const double last = direction(points.size() - 1);
  return std::abs(normalized_angle(middle - first) + normalized_angle(last - middle));
}

}  // namespace quoin
