// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/geometry/angle.hpp"
#include "core/geometry/line.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Direction [rad] and offset [m] of a line at a point, seen from the side where its normal has
/// about the direction `alpha`.
struct LineAt {
  double alpha;
  double offset;
  Eigen::Matrix2d covariance;

  LineAt(const LineEstimate& estimate, const Eigen::Vector2d& point, double near_alpha) {
    const Eigen::Vector2d normal = estimate.line.normal();
    alpha = estimate.line.alpha;
    offset = estimate.line.r - normal.dot(point);
    covariance = estimate.about(normal.x() * point.y() - normal.y() * point.x()).covariance;
    if (std::abs(normalized_angle(alpha - near_alpha)) > 0.5 * pi) {
      alpha += pi;
      offset = -offset;
      covariance(0, 1) = -covariance(0, 1);
      covariance(1, 0) = -covariance(1, 0);
    }
  }
};

/// The difference of two independent estimates of one line at a point of the wall [m]: of direction
/// [rad] and offset across the wall [m], seen from the side of the first. At the foot of the
/// perpendicular, which may be far from the wall, a change of direction moves r by more than its
/// first order; at the wall it does not.
struct LineDifference {
  LineDifference(const LineEstimate& first, const LineEstimate& second,
                 const Eigen::Vector2d& point) {
    const LineAt a(first, point, first.line.alpha);
    const LineAt b(second, point, first.line.alpha);
    difference = {normalized_angle(a.alpha - b.alpha), a.offset - b.offset};
    covariance = a.covariance + b.covariance;
  }

  /// Squared Mahalanobis distance, chi-square with two degrees of freedom when both covariances are
  /// true; +inf where they are none.
  [[nodiscard]] double mahalanobis_squared() const {
    const double determinant =
        covariance(0, 0) * covariance(1, 1) - covariance(0, 1) * covariance(0, 1);
    if (!(covariance(0, 0) > 0.0 && determinant > 0.0)) {
      return std::numeric_limits<double>::infinity();
    }
    const double alpha = difference.x();
    const double offset = difference.y();
    return (covariance(1, 1) * alpha * alpha - 2.0 * covariance(0, 1) * alpha * offset +
            covariance(0, 0) * offset * offset) /
           determinant;
  }

  Eigen::Vector2d difference;  ///< (alpha, offset)
  Eigen::Matrix2d covariance;  ///< [rad^2, rad m; rad m, m^2]
};

/// Squared Mahalanobis distance of a line from the true one, at the middle of what is seen of it.
[[nodiscard]] inline double squared_error(const LineSegment& found, const Line& truth) {
  const LineEstimate exact{truth, Eigen::Matrix2d::Zero()};
  return LineDifference(found.estimate, exact, 0.5 * (found.start + found.end))
      .mahalanobis_squared();
}

/// Copies every other point, from index `first` (0 or 1) on; `points` are more than that.
inline void take_every_other(const PointsView& points, std::size_t first, Points& taken) {
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

/// Squared Mahalanobis distance of the lines of the even and of the odd points, of which there are
/// at least two each, compared at the middle of the wall: what the noise of single rays makes of
/// it, because the two share everything else. Nothing when one has no line. `scratch` is working
/// memory.
[[nodiscard]] inline std::optional<double> odd_even_squared(const Fitter& fitter,
                                                            const PointsView& points,
                                                            const SensorModel& sensor,
                                                            Points& scratch) {
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
