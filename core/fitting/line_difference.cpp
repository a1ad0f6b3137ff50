// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/line_difference.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

/// Direction [rad] and offset [m] of a line at a point, seen from the side where its normal has
/// about the direction `alpha`.
struct LineAt {
  double alpha;
  double offset;
  Eigen::Matrix2d covariance;

  LineAt(const LineEstimate& estimate, const Eigen::Vector2d& point, double near_alpha) {
    const bool turned = std::abs(normalized_angle(estimate.line.alpha - near_alpha)) > 0.5 * pi;
    alpha = estimate.line.alpha + (turned ? pi : 0.0);
    const double r = turned ? -estimate.line.r : estimate.line.r;
    const Eigen::Vector2d normal(std::cos(alpha), std::sin(alpha));
    offset = r - normal.dot(point);
    const double along = normal.x() * point.y() - normal.y() * point.x();
    Eigen::Matrix2d jacobian;  // of (alpha, offset) by (alpha, r)
    jacobian << 1.0, 0.0, -along, 1.0;
    Eigen::Matrix2d of_normal_form = estimate.covariance;
    if (turned) {
      of_normal_form(0, 1) = -of_normal_form(0, 1);
      of_normal_form(1, 0) = -of_normal_form(1, 0);
    }
    covariance = jacobian * of_normal_form * jacobian.transpose();
  }
};

}  // namespace

LineDifference::LineDifference(const LineEstimate& first, const LineEstimate& second,
                               const Eigen::Vector2d& point) {
  const LineAt a(first, point, first.line.alpha);
  const LineAt b(second, point, first.line.alpha);
  difference = {normalized_angle(a.alpha - b.alpha), a.offset - b.offset};
  covariance = a.covariance + b.covariance;
}

double LineDifference::mahalanobis_squared() const {
  const Eigen::LLT<Eigen::Matrix2d> factor(covariance);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  return difference.dot(factor.solve(difference));
}

void take_every_other(const PointsView& points, std::size_t first, Points& taken) {
  const std::size_t count = (points.size() - first + 1) / 2;
  taken.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + 2 * k;
    taken.range[k] = points.range[i];
    taken.bearing[k] = points.bearing[i];
    taken.inverse_range[k] = points.inverse_range[i];
    taken.cosine[k] = points.cosine[i];
    taken.sine[k] = points.sine[i];
    taken.x[k] = points.x[i];
    taken.y[k] = points.y[i];
  }
}

std::optional<double> odd_even_squared(const Fitter& fitter, const PointsView& points,
                                       const SensorModel& sensor, Points& scratch) {
  take_every_other(points, 0, scratch);
  const FitResult even = fitter(scratch, sensor);
  if (!even.ok()) return std::nullopt;
  const LineSegment wall = line_segment(even.estimate, even.normal, scratch);
  take_every_other(points, 1, scratch);
  const FitResult odd = fitter(scratch, sensor);
  if (!odd.ok()) return std::nullopt;
  return LineDifference(even.estimate, odd.estimate, 0.5 * (wall.start + wall.end))
      .mahalanobis_squared();
}

}  // namespace quoin
