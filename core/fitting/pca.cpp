// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/pca.hpp"

#include "core/fitting/offset_at_mean.hpp"
#include "core/fitting/orthogonal.hpp"

namespace quoin {
namespace {

Eigen::Matrix2d covariance_from_residuals(const OrthogonalLine& fit) {
  const double variance = fit.across / (fit.moments.weight - 2.0);
  return from_offset_at_mean({variance / fit.along, 0.0, variance / fit.moments.weight},
                             fit.tangential_mean());
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
