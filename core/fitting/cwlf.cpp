// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/cwlf.hpp"

namespace quoin {

AxisRegression cwlf_line(const PointsView& points, const SensorModel& sensor) {
  return fit_axis(points, AxisWeights::conditional, WeightVariances(sensor));
}

Eigen::Matrix2d cwlf_covariance(const PointsView& points, const SensorModel& sensor,
                                const AxisRegression& fit, CovarianceMode mode) {
  if (mode == CovarianceMode::propagated) {
    return to_normal_form(fit, axis_influence(points, AxisWeights::conditional, fit, sensor));
  }
  // Eq. (31) and (32); the sums hold the weights times both variances.
  const WeightVariances variances(sensor);
  const double scale = variances.range * variances.bearing;
  return to_normal_form(fit, {scale / fit.spread, 0.0, scale / fit.weight});
}

FitResult Cwlf::operator()(const PointsView& points, const SensorModel& sensor) const {
  const AxisRegression fit = cwlf_line(points, sensor);
  if (fit.failure != FitFailure::none) return FitResult::failed(fit.failure);
  return FitResult::fitted(fit.line, cwlf_covariance(points, sensor, fit, parameters_.covariance));
}

}  // namespace quoin
