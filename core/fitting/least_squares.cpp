// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/least_squares.hpp"

#include "core/fitting/axis_regression.hpp"

namespace quoin {

FitResult LeastSquares::operator()(const PointsView& points, const SensorModel& sensor) const {
  const bool from_residuals = parameters_.covariance == CovarianceMode::as_published;
  if (from_residuals && points.size() < 3) return FitResult::failed(FitFailure::too_few_points);
  const AxisRegression fit = fit_axis(points, AxisWeights::equal, WeightVariances(sensor));
  if (fit.failure != FitFailure::none) return FitResult::failed(fit.failure);
  const double variance = fit.residual / (fit.weight - 2.0);
  const Symmetric2 covariance = from_residuals
                                    ? Symmetric2{variance / fit.spread, 0.0, variance / fit.weight}
                                    : axis_influence(points, AxisWeights::equal, fit, sensor);
  return FitResult::fitted(fit.line, to_normal_form(fit, covariance));
}

}  // namespace quoin
