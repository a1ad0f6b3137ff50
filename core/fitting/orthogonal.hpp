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

/// Orthogonal fit with equal weights: through the mean of the points, along the eigenvector of the
/// larger eigenvalue of their covariance matrix (principal component analysis). Biased where the
/// noise along the rays is not across the line.
///
/// `as_published`: the paper gives no covariance; this is the textbook one, which takes the scale
/// of the noise from the residuals, independent of the sensor model. It needs three points.
class Pca {
 public:
  static constexpr const char* name = "pca";
  static constexpr const char* description =
      "orthogonal line fit with equal weights by principal components";
  static constexpr const char* source = "Opromolla et al. 2017, section 2";
  static constexpr const char* choose =
      "Where the noise is small against the size of the room, also for lines through the sensor: "
      "in a large one even better than wctls at 50 mm. Not at 50 mm in a small room, where it is "
      "biased; as_published it needs no noise model, but too few corners lie in their ellipses.";

  using Parameters = CovarianceParameters;

  Pca() = default;
  explicit Pca(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    const bool from_residuals = parameters_.covariance == CovarianceMode::as_published;
    if (from_residuals && points.size() < 3) return FitResult::failed(FitFailure::too_few_points);
    const OrthogonalLine fit = fit_orthogonal(points, PointWeights::equal);
    if (!fit.ok()) return FitResult::failed(fit.failure);
    return fitted(fit, from_residuals
                           ? residual_covariance(fit)
                           : orthogonal_covariance(points, PointWeights::equal, fit, sensor));
  }

 private:
  Parameters parameters_;
};

/// First step of the method: the line, eq. (16) and (17).
[[nodiscard]] inline OrthogonalLine arras_siegwart_line(const PointsView& points) {
  return fit_orthogonal(points, PointWeights::inverse_square_range);
}

/// Second step: the covariance of (alpha, r) of that line, eq. (19).
[[nodiscard]] inline Eigen::Matrix2d arras_siegwart_covariance(const PointsView& points,
                                                               const SensorModel& sensor,
                                                               const OrthogonalLine& fit,
                                                               CovarianceMode mode) {
  SensorModel counted = sensor;
  if (mode == CovarianceMode::as_published) counted.bearing_stddev = 0.0;
  return orthogonal_covariance(points, PointWeights::inverse_square_range, fit, counted);
}

/// Weighted orthogonal fit of Arras and Siegwart with the weights 1 / (sigma_rho rho sigma_theta)^2
/// of the CWLF paper's eq. (3), in the form whose time grows with the number of points instead of
/// its square (see arras_siegwart_literal in core/evaluation/papers/cwlf_paper.hpp). The standard
/// deviations cancel in the line. The estimator is biased where the noise along the rays is not
/// across the line.
///
/// `as_published` keeps the range noise only, as the reference they compare with does.
class ArrasSiegwart {
 public:
  static constexpr const char* name = "arras_siegwart";
  static constexpr const char* description = "orthogonal line fit with weights 1 / range^2";
  static constexpr const char* source =
      "Arras & Siegwart 1998; Prieto-Fernandez et al. 2024, eq. 3, 16-19";
  static constexpr const char* choose =
      "A classic to compare with, and good where the noise is small against the size of the room: "
      "in a large one even better than wctls at 50 mm. Not at 50 mm in a small room, where it is "
      "biased; its as_published ellipses leave out the bearing noise and are too small.";

  using Parameters = CovarianceParameters;

  ArrasSiegwart() = default;
  explicit ArrasSiegwart(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    const OrthogonalLine fit = arras_siegwart_line(points);
    if (!fit.ok()) return FitResult::failed(fit.failure);
    return fitted(fit, arras_siegwart_covariance(points, sensor, fit, parameters_.covariance));
  }

 private:
  Parameters parameters_;
};

}  // namespace quoin
