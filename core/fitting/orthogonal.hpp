// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/point_sums.hpp"

namespace quoin {

/// The line that minimises the weighted sum of squared distances of the points to it: through their
/// mean, along the eigenvector of the larger eigenvalue of their scatter matrix. Defined for lines
/// through the sensor too, where the offset is 0.
struct OrthogonalLine {
  FitFailure failure = FitFailure::degenerate;
  NormalLine line;
  CentralMoments moments;
  double across = 0.0;  ///< smaller eigenvalue: sum of squared distances from the line, not < 0
  double along = 0.0;   ///< larger one: sum of squares along the line, about the mean

  [[nodiscard]] bool ok() const { return failure == FitFailure::none; }

  /// Coordinate of the mean along the line [m].
  [[nodiscard]] double tangential_mean() const {
    return line.along(moments.mean_x, moments.mean_y);
  }
};

/// From moments alone; the offset may be negative.
[[nodiscard]] OrthogonalLine orthogonal_line(const CentralMoments& moments);

/// The same from moments about the sensor. They lose digits: what rounding leaves of points at this
/// distance is no direction.
[[nodiscard]] OrthogonalLine orthogonal_line(const Moments& moments);

/// The line of the points, with an offset that is not negative.
[[nodiscard]] OrthogonalLine fit_orthogonal(const PointsView& points, PointWeights weights);

/// The line of `fit_orthogonal` with its covariance.
[[nodiscard]] inline FitResult fitted(const OrthogonalLine& fit,
                                      const Eigen::Matrix2d& covariance) {
  return FitResult::fitted(fit.line.normal_form(), {fit.line.normal_x, fit.line.normal_y},
                           covariance);
}

/// Covariance of (alpha, r) as the sum of the first-order contributions of range and bearing noise
/// of each point, the weights differentiated with the range.
[[nodiscard]] Eigen::Matrix2d orthogonal_covariance(const PointsView& points, PointWeights weights,
                                                    const OrthogonalLine& fit,
                                                    const SensorModel& sensor);

/// Textbook covariance of (alpha, r), which takes the scale of the noise from the residuals. Equal
/// weights, at least three points.
[[nodiscard]] Eigen::Matrix2d residual_covariance(const OrthogonalLine& fit);

}  // namespace quoin
