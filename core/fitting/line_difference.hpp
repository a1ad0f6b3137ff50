// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/geometry/line.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// The difference of two independent estimates of one line at a point of the wall [m]: of direction
/// [rad] and offset across the wall [m], seen from the side of the first. At the foot of the
/// perpendicular, which may be far from the wall, a change of direction moves r by more than its
/// first order; at the wall it does not.
struct LineDifference {
  LineDifference(const LineEstimate& first, const LineEstimate& second,
                 const Eigen::Vector2d& point);

  /// Squared Mahalanobis distance, chi-square with two degrees of freedom when both covariances are
  /// true; +inf where they are none.
  [[nodiscard]] double mahalanobis_squared() const;

  Eigen::Vector2d difference;  ///< (alpha, offset)
  Eigen::Matrix2d covariance;  ///< [rad^2, rad m; rad m, m^2]
};

/// Copies every other point, from index `first` (0 or 1) on; `points` are more than that.
void take_every_other(const PointsView& points, std::size_t first, Points& taken);

/// Squared Mahalanobis distance of the lines of the even and of the odd points, of which there are
/// at least two each, compared at the middle of the wall: what the noise of single rays makes of
/// it, because the two share everything else. Nothing when one has no line. `scratch` is working
/// memory.
[[nodiscard]] std::optional<double> odd_even_squared(const Fitter& fitter, const PointsView& points,
                                                     const SensorModel& sensor, Points& scratch);

}  // namespace quoin
