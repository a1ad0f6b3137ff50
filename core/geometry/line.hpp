// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace quoin {

/// Line in Hessian normal form, x cos(alpha) + y sin(alpha) = r.
struct Line {
  double alpha = 0.0;  ///< [rad] direction of the normal, in (-pi, pi]
  double r = 0.0;      ///< [m] distance from the sensor, >= 0

  /// Unit vector (cos(alpha), sin(alpha)), from the sensor towards the line.
  [[nodiscard]] Eigen::Vector2d normal() const;
};

/// A line with the covariance of (alpha, r), 2x2 [rad^2, rad m; rad m, m^2].
struct LineEstimate {
  Line line;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// The same line with r >= 0 and alpha in (-pi, pi]; the covariance changes sign with r where it
/// must.
[[nodiscard]] LineEstimate normalized(const LineEstimate& estimate);

}  // namespace quoin
