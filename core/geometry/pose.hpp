// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace quoin {

/// Position and heading in the plane (REP-103).
struct Pose2 {
  double x = 0.0;      ///< [m]
  double y = 0.0;      ///< [m]
  double theta = 0.0;  ///< [rad] counter-clockwise

  /// A point given in this pose's frame, in the frame the pose is given in.
  [[nodiscard]] Eigen::Vector2d transform(const Eigen::Vector2d& point) const {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    return {x + c * point.x() - s * point.y(), y + s * point.x() + c * point.y()};
  }

  /// The inverse of `transform`.
  [[nodiscard]] Eigen::Vector2d inverse_transform(const Eigen::Vector2d& point) const {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    const double dx = point.x() - x;
    const double dy = point.y() - y;
    return {c * dx + s * dy, -s * dx + c * dy};
  }
};

}  // namespace quoin
