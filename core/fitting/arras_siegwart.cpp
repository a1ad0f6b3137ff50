// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/arras_siegwart.hpp"

namespace quoin {

OrthogonalLine arras_siegwart_line(const PointsView& points) {
  return fit_orthogonal(points, PointWeights::inverse_square_range);
}

Eigen::Matrix2d arras_siegwart_covariance(const PointsView& points, const SensorModel& sensor,
                                          const OrthogonalLine& fit, CovarianceMode mode) {
  const double bearing_stddev = mode == CovarianceMode::propagated ? sensor.bearing_stddev : 0.0;
  return orthogonal_covariance(points, PointWeights::inverse_square_range, fit,
                               sensor.range_stddev * sensor.range_stddev,
                               bearing_stddev * bearing_stddev);
}

FitResult ArrasSiegwart::operator()(const PointsView& points, const SensorModel& sensor) const {
  const OrthogonalLine fit = arras_siegwart_line(points);
  if (fit.failure != FitFailure::none) return FitResult::failed(fit.failure);
  return FitResult::fitted(fit.line,
                           arras_siegwart_covariance(points, sensor, fit, parameters_.covariance));
}

}  // namespace quoin
