// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/algebraic.hpp"
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

/// Regression of the inverse range on (cos, sin) of the bearing, the line of WTLS and WCTLS, and
/// from there two steps of maximum likelihood, each ray weighted with the variance that range and
/// bearing noise give it. One step is not enough where the noise of the bearings is as large as
/// their spacing and biases the regression; a third changes nothing that matters.
///
/// The covariance is the Cramer-Rao bound in both modes: no paper prints another one. Fails as
/// `through_sensor` where the line is too near the sensor for the regression.
class InverseRange {
 public:
  static constexpr const char* name = "inverse_range";
  static constexpr const char* description =
      "inverse range regressed with the variance of each ray; reaches the Cramer-Rao bound";
  static constexpr const char* source =
      "weighted least squares on the noise model of ranges and bearings";
  static constexpr const char* choose =
      "For nearly everything: as accurate as maximum_likelihood and with as true a covariance "
      "at any noise, in half of its time and without an open-ended iteration. Within a few "
      "centimetres of the sensor it names through_sensor.";

  using Parameters = CovarianceParameters;

  InverseRange() = default;
  explicit InverseRange(const Parameters&) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    constexpr int steps = 2;
    constexpr double longest_last_step = 0.25;  // standard deviations, squared
    Eigen::Vector2d q;
    const FitFailure failure = find_algebraic_line(points, PointWeights::inverse_square_range, q);
    if (failure != FitFailure::none) return FitResult::failed(failure);
    const WeightVariances variances(sensor);
    const Eigen::Vector2d anchor(0.5 * (points.x.front() + points.x.back()),
                                 0.5 * (points.y.front() + points.y.back()));
    NormalLine line = normal_line(q);
    for (int step = 1;; ++step) {
      const NormalResiduals sums = normal_residuals(points, line, anchor, variances, line);
      // Fisher's scoring: the information stands for the Hessian.
      const auto change = solve2x2(sums.information, -sums.gradient);
      if (!change) return FitResult::failed(reason_of_singularity(points));
      line = moved(line, anchor, change->x);
      if (step < steps) continue;
      // Near the sensor, for the noise of the bearings, the regression is too far off to start
      // from.
      if (!(-change->x.dot(sums.gradient) <= longest_last_step)) {
        return FitResult::failed(FitFailure::through_sensor);
      }
      return fitted(line, anchor, sums);
    }
  }
};

/// Minimises the sum of d^2 / v, with d = rho cos(phi) - r the distance of a point from the line
/// and v = sigma_rho^2 cos^2(phi) + rho^2 sigma_theta^2 sin^2(phi) the variance that range and
/// bearing noise give it, phi being the incidence angle. v turns with the line, and its derivative
/// is part of the gradient: that is what keeps the estimate free of the bias of orthogonal fits.
/// Defined for all lines, those through the sensor included, where a residual along the ray is not.
///
/// The covariance is the Cramer-Rao bound at the line in both modes: no paper prints another one.
class MaximumLikelihood {
 public:
  static constexpr const char* name = "maximum_likelihood";
  static constexpr const char* description =
      "iterated fit on the noise model of each ray; reaches the Cramer-Rao bound";
  static constexpr const char* source =
      "Newton iteration on the noise model of ranges and bearings";
  static constexpr const char* choose =
      "Where lines may pass through the sensor, or as the reference: attains the Cramer-Rao "
      "bound at any noise, with a covariance that holds. The noise model must be right, for it "
      "takes its weights from it.";

  using Parameters = CovarianceParameters;

  MaximumLikelihood() = default;
  explicit MaximumLikelihood(const Parameters&) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const;
};

}  // namespace quoin
