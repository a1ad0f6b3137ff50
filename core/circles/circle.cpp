// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/circles/circle.hpp"

#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>

#include "core/fitting/point_sums.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

constexpr int gauss_newton_steps = 3;
constexpr int newton_steps = 20;
constexpr double small_step = 1e-8;  // the next is its square

/// Means over the points; z = x^2 + y^2.
struct CircleMoments {
  double x = 0.0, y = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  double xz = 0.0, yz = 0.0, zz = 0.0;
};

/// About the origin (origin_x, origin_y).
QUOIN_MULTIVERSION
void add_up(const double* __restrict x, const double* __restrict y, std::size_t count,
            double origin_x, double origin_y, CircleMoments& out) {
  CircleMoments m;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = x[i] - origin_x;
    const double v = y[i] - origin_y;
    const double uu = u * u;
    const double vv = v * v;
    const double w = uu + vv;
    m.x += u;
    m.y += v;
    m.xx += uu;
    m.xy += u * v;
    m.yy += vv;
    m.xz += u * w;
    m.yz += v * w;
    m.zz += w * w;
  }
  out = m;
}

/// The same about the mean. That the origin was near the points keeps the digits.
CircleMoments centered(const CircleMoments& sums, double count) {
  const double scale = 1.0 / count;
  const double x = sums.x * scale;
  const double y = sums.y * scale;
  const double square = x * x + y * y;
  const double xx = sums.xx * scale;
  const double xy = sums.xy * scale;
  const double yy = sums.yy * scale;
  const double z = xx + yy;
  const double xz = sums.xz * scale;
  const double yz = sums.yz * scale;
  CircleMoments m;
  m.x = x;
  m.y = y;
  m.xx = xx - x * x;
  m.xy = xy - x * y;
  m.yy = yy - y * y;
  // z about the mean is z - 2 (x mean_x + y mean_y) + square.
  m.xz = xz - x * z - 2.0 * (x * m.xx + y * m.xy);
  m.yz = yz - y * z - 2.0 * (x * m.xy + y * m.yy);
  m.zz = sums.zz * scale - 4.0 * (x * xz + y * yz) + 2.0 * square * z +
         4.0 * (x * x * xx + 2.0 * x * y * xy + y * y * yy) - 3.0 * square * square;
  return m;
}

/// Half of the constraint's coefficient of A D; that of A^2 is such that all have one polynomial.
double half_of_ad(CircleConstraint constraint) {
  switch (constraint) {
    case CircleConstraint::pratt:
      return -2.0;
    case CircleConstraint::hyper:
      return 2.0;
    case CircleConstraint::taubin:
      break;
  }
  return 0.0;
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

std::optional<Circle> fit_algebraic_circle(const PointsView& points, CircleConstraint constraint) {
  const std::size_t count = points.size();
  if (count < 3) return std::nullopt;
  const double origin_x = points.x[count / 2];
  const double origin_y = points.y[count / 2];
  CircleMoments sums;
  add_up(points.x.data(), points.y.data(), count, origin_x, origin_y, sums);
  const CircleMoments m = centered(sums, static_cast<double>(count));

  // With A = 1 and the eigenvalue e, the rows of B, C and D of the matrix (moments - e constraint)
  // give these; the row of A is the polynomial f(e) whose smallest positive root is wanted. It
  // falls and is convex up to there, so that Newton's method from 0 comes to it from below.
  const double z = m.xx + m.yy;
  const double variance = m.zz - z * z;
  const double determinant = m.xx * m.yy - m.xy * m.xy;
  const double third = m.xz * m.xz + m.yz * m.yz;
  const double adjugate = m.xz * m.xz * m.yy - 2.0 * m.xz * m.yz * m.xy + m.yz * m.yz * m.xx;
  const double ad = half_of_ad(constraint);
  double root = 0.0;
  for (int k = 0; k < newton_steps; ++k) {
    const double first = variance - root * (4.0 * z + ad * ad * root);
    const double second = determinant - root * (z - root);
    const double value = first * second - adjugate + root * third;
    const double slope =
        third - (4.0 * z + 2.0 * ad * ad * root) * second - first * (z - 2.0 * root);
    const double step = value / slope;
    if (!std::isfinite(step)) break;
    root -= step;
    if (std::abs(step) <= small_step * z) break;
  }
  const double scale = 0.5 / (determinant - root * (z - root));
  const Eigen::Vector2d center(scale * (m.xz * (m.yy - root) - m.yz * m.xy),
                               scale * (m.yz * (m.xx - root) - m.xz * m.xy));
  const double radius = std::sqrt(center.squaredNorm() + z - ad * root);
  if (!center.allFinite() || !std::isfinite(radius) || !(radius > 0.0)) return std::nullopt;
  return Circle{center + Eigen::Vector2d(m.x + origin_x, m.y + origin_y), radius};
}

std::optional<Circle> fit_circle(const PointsView& points, const SensorModel& sensor) {
  std::optional<Circle> circle = fit_algebraic_circle(points, CircleConstraint::taubin);
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
