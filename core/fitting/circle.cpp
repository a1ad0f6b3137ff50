// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/circle.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "core/fitting/algebraic_circle.hpp"
#include "core/fitting/point_sums.hpp"
#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr int gauss_newton_steps = 3;

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
