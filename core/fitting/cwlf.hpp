// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/axis_regression.hpp"

namespace quoin {

/// First step of the method: the line.
[[nodiscard]] inline AxisRegression cwlf_line(const PointsView& points, const SensorModel& sensor) {
  return fit_axis(points, AxisWeights::conditional, WeightVariances::of_middle(sensor, points));
}

/// Second step: the covariance of (alpha, r) of that line.
[[nodiscard]] inline Eigen::Matrix2d cwlf_covariance(const PointsView& points,
                                                     const SensorModel& sensor,
                                                     const AxisRegression& fit,
                                                     CovarianceMode mode) {
  if (mode == CovarianceMode::propagated) {
    return to_normal_form(fit, axis_covariance(points, AxisWeights::conditional, fit, sensor));
  }
  // Eq. (31) and (32); the sums hold the weights times both variances.
  const WeightVariances variances = WeightVariances::of_middle(sensor, points);
  const double scale = variances.range * variances.bearing;
  return to_normal_form(fit, {scale / fit.spread, 0.0, scale / fit.weight});
}

/// Conditional weighted linear fitting: regression of y on x, or of x on y where the points spread
/// further along y (eq. 20 to 35), each point weighted by the inverse of its conditional variance
/// (eq. 23, 34). The noise of the abscissa biases the slope.
///
/// `as_published`: eq. (31) and (32), which take the conditional variances for those of the
/// residuals. They never are larger, so that the ellipses come out too small.
class Cwlf {
 public:
  static constexpr const char* name = "cwlf";
  static constexpr const char* description =
      "conditional weighted linear fitting: regression along the axis of larger spread";
  static constexpr const char* source = "Prieto-Fernandez et al. 2024, eq. 20-35";
  static constexpr const char* choose =
      "To repeat the paper. Propagated it is as good as the others at 10 mm of noise, but biased "
      "at 50 mm in a small room, so that too few corners lie in their ellipses; as_published the "
      "ellipses are too small at any noise.";

  using Parameters = CovarianceParameters;

  Cwlf() = default;
  explicit Cwlf(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    const AxisRegression fit = cwlf_line(points, sensor);
    if (fit.failure != FitFailure::none) return FitResult::failed(fit.failure);
    return FitResult::fitted(fit.line,
                             cwlf_covariance(points, sensor, fit, parameters_.covariance));
  }

 private:
  Parameters parameters_;
};

}  // namespace quoin
