// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/inverse_line.hpp"
#include "core/fitting/symmetric2.hpp"
#include "core/fitting/weight_variances.hpp"

namespace quoin {

/// A line by its unit normal and its offset [m] along it from an anchor, a point in the middle of
/// the points: about there alpha and offset are nearly uncorrelated.
struct AnchoredLine {
  Eigen::Vector2d anchor;  ///< [m]
  Eigen::Vector2d normal;
  double offset = 0.0;  ///< [m]

  [[nodiscard]] double r() const { return normal.dot(anchor) + offset; }

  /// Coordinate of the anchor along the line [m].
  [[nodiscard]] double tangential() const {
    return normal.x() * anchor.y() - normal.y() * anchor.x();
  }

  /// Turned by `step.x()` [rad] about the anchor and moved by `step.y()` [m].
  [[nodiscard]] AnchoredLine moved(const Eigen::Vector2d& step) const;
};

/// Half the sum of d^2 / v and its derivatives with (alpha, offset). d is the distance of a
/// measured point from the line, v its variance by the noise of range and bearing. That sum, v
/// differentiated too, is what remains of the likelihood once the unknown true place of each point
/// on the line has been eliminated; its minimum is not biased by the noise of the bearings, unlike
/// the sum of squared radial residuals at the measured bearings.
struct NormalResiduals {
  double value = 0.0;      ///< sum of d^2 / v
  Symmetric2 information;  ///< of Fisher, with the estimated place of each point along the line
  double xx = 0.0;         ///< second derivatives where they differ from that, if asked for
  double xy = 0.0;
  double descent_x = 0.0;  ///< first derivatives, turned downhill
  double descent_y = 0.0;
  double scatter = 0.0;  ///< share of information.xx that is noise along the line
};

[[nodiscard]] NormalResiduals normal_residuals(const PointsView& points, const AnchoredLine& line,
                                               const WeightVariances& variances);

[[nodiscard]] NormalResiduals normal_residuals_with_curvature(const PointsView& points,
                                                              const AnchoredLine& line,
                                                              const WeightVariances& variances);

/// The line with the covariance of (alpha, r): the Cramer-Rao bound from the Fisher information
/// less what the points' noise along the line adds to their spread; degenerate when the information
/// is singular.
[[nodiscard]] FitResult fitted(const AnchoredLine& line, const NormalResiduals& residuals);

}  // namespace quoin
