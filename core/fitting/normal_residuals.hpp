// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/point_sums.hpp"

namespace quoin {

/// Half the sum of d^2 / v and its derivatives with (alpha, offset), the line being turned about an
/// anchor, a point in the middle of the points: about there the two are nearly uncorrelated. d is
/// the distance of a measured point from the line, v its variance by the noise of range and
/// bearing. That sum, v differentiated too, is what remains of the likelihood once the unknown true
/// position of each point on the line has been eliminated; its minimum is not biased by the noise
/// of the bearings, unlike the sum of squared radial residuals at the measured bearings.
///
/// A variance that grows with the range is that of the range at which the ray meets
/// `variance_line`, a line that does not turn with this one: a variance by measured ranges would
/// favour those that are too short.
struct NormalResiduals {
  double value = 0.0;       ///< sum of d^2 / v
  Symmetric2 information;   ///< of Fisher, with the estimated position of each point along the line
  double hessian_xx = 0.0;  ///< where it differs from the information, if asked for
  double hessian_xy = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  double noise_along = 0.0;  ///< share of information.xx that is noise along the line
};

[[nodiscard]] NormalResiduals normal_residuals(const PointsView& points, const NormalLine& line,
                                               const Eigen::Vector2d& anchor,
                                               const WeightVariances& variances,
                                               const NormalLine& variance_line);

[[nodiscard]] NormalResiduals normal_residuals_with_hessian(const PointsView& points,
                                                            const NormalLine& line,
                                                            const Eigen::Vector2d& anchor,
                                                            const WeightVariances& variances,
                                                            const NormalLine& variance_line);

/// Turned by `step.x()` [rad] about the anchor and moved by `step.y()` [m].
[[nodiscard]] NormalLine moved(const NormalLine& line, const Eigen::Vector2d& anchor,
                               const Eigen::Vector2d& step);

/// The line with the covariance of (alpha, r): the Cramer-Rao bound from the Fisher information
/// less what the points' noise along the line adds to their spread; degenerate when the information
/// is singular.
[[nodiscard]] FitResult fitted(const NormalLine& line, const Eigen::Vector2d& anchor,
                               const NormalResiduals& residuals);

}  // namespace quoin
