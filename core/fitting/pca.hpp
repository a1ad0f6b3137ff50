// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/orthogonal.hpp"

namespace quoin {

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

}  // namespace quoin
