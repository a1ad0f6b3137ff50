// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/moments.hpp"

namespace quoin {

/// The line that minimises the weighted sum of squared distances of the points to it, with what its
/// covariance needs. Defined for lines through the sensor too, where r is 0.
struct OrthogonalLine {
  FitFailure failure = FitFailure::none;
  Line line;
  double normal_x = 1.0;  ///< cos(alpha)
  double normal_y = 0.0;  ///< sin(alpha)
  Moments moments;
  double across = 0.0;  ///< weighted sum of squares of the distances from the line
  double along = 0.0;   ///< weighted sum of squares along the line, about the mean

  /// Coordinate of the mean along the line [m].
  [[nodiscard]] double tangential_mean() const {
    return moments.mean_y * normal_x - moments.mean_x * normal_y;
  }
};

/// Through the weighted mean, along the eigenvector of the larger eigenvalue of the spread.
[[nodiscard]] OrthogonalLine fit_orthogonal(const PointsView& points, PointWeights weights);

/// Covariance of (alpha, r) as the sum of the first-order contributions of range and bearing noise
/// of each point, the weights differentiated with the range.
[[nodiscard]] Eigen::Matrix2d orthogonal_covariance(const PointsView& points, PointWeights weights,
                                                    const OrthogonalLine& fit,
                                                    double range_variance, double bearing_variance);

}  // namespace quoin
