// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/pca.hpp"

#include "core/fitting/orthogonal.hpp"

namespace quoin {
namespace {

Eigen::Matrix2d covariance_from_residuals(const OrthogonalLine& fit) {
  const double variance = fit.across / (fit.moments.weight - 2.0);
  const double t = fit.tangential_mean();
  const double alpha_alpha = variance / fit.along;
  Eigen::Matrix2d covariance;
  covariance(0, 0) = alpha_alpha;
  covariance(0, 1) = t * alpha_alpha;
  covariance(1, 0) = covariance(0, 1);
  covariance(1, 1) = variance / fit.moments.weight + t * t * alpha_alpha;
  return covariance;
}

}  // namespace

FitResult Pca::operator()(const PointsView& points, const SensorModel& sensor) const {
  const bool from_residuals = parameters_.covariance == CovarianceMode::as_published;
  if (from_residuals && points.size() < 3) return FitResult::failed(FitFailure::too_few_points);
  const OrthogonalLine fit = fit_orthogonal(points, PointWeights::equal);
  if (fit.failure != FitFailure::none) return FitResult::failed(fit.failure);
  return FitResult::fitted(
      fit.line, from_residuals
                    ? covariance_from_residuals(fit)
                    : orthogonal_covariance(points, PointWeights::equal, fit,
                                            sensor.range_stddev * sensor.range_stddev,
                                            sensor.bearing_stddev * sensor.bearing_stddev));
}

}  // namespace quoin
