// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/axis_regression.hpp"

namespace quoin {

/// Ordinary regression of y on x, or of x on y where the points spread further along y, with equal
/// weights: the traditional method that others compare with. The noise of the abscissa biases the
/// slope.
///
/// `as_published`: textbook covariance of ordinary least squares, which takes the scale of the
/// noise from the residuals, independent of the sensor model. It needs three points.
class LeastSquares {
 public:
  static constexpr const char* name = "least_squares";
  static constexpr const char* description =
      "ordinary regression along the axis of larger spread, equal weights";
  static constexpr const char* source = "textbook; choice of the axis by Vandorpe et al. 1996";
  static constexpr const char* choose =
      "As the baseline to compare with. Propagated it does well at 10 mm of noise; at 50 mm too "
      "few corners lie in their ellipses, in a small room above all, where it is biased.";

  using Parameters = CovarianceParameters;

  LeastSquares() = default;
  explicit LeastSquares(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    const bool from_residuals = parameters_.covariance == CovarianceMode::as_published;
    if (from_residuals && points.size() < 3) return FitResult::failed(FitFailure::too_few_points);
    const AxisRegression fit = fit_axis(points, AxisWeights::equal, WeightVariances(sensor));
    if (fit.failure != FitFailure::none) return FitResult::failed(fit.failure);
    const double variance = fit.residual / (fit.weight - 2.0);
    const Symmetric2 covariance =
        from_residuals ? Symmetric2{variance / fit.spread, 0.0, variance / fit.weight}
                       : axis_covariance(points, AxisWeights::equal, fit, sensor);
    return FitResult::fitted(fit.line, to_normal_form(fit, covariance));
  }

 private:
  Parameters parameters_;
};

}  // namespace quoin
