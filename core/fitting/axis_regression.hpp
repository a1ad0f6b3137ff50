// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/point_sums.hpp"

namespace quoin {

/// Regression line v = slope (u - mean) + intercept with (u, v) = (x, y), or (y, x) when the points
/// spread further along y (Vandorpe's choice, CWLF eq. 20 and 21). Not a NormalLine: the covariance
/// belongs to slope and intercept, and so do the equations.
struct AxisRegression {
  FitFailure failure = FitFailure::none;
  bool y_on_x = true;
  double slope = 0.0;
  double intercept = 0.0;  ///< [m] v at the mean of u
  double mean = 0.0;       ///< [m] weighted mean of u
  double weight = 0.0;     ///< sum of the weights
  double spread = 0.0;     ///< weighted sum of (u - mean)^2
  double residual = 0.0;   ///< weighted sum of the squares of what is left of v
  Line line;               ///< the same in normal form
  bool turned = false;     ///< whether the normal form's normal points to -v
};

/// How the ordinates are weighted.
enum class AxisWeights {
  equal,
  conditional,  ///< inverse of the variance of v given u, CWLF eq. (23) and (34)
};

/// The weights are of one range variance, `variances.range`.
[[nodiscard]] AxisRegression fit_axis(const PointsView& points, AxisWeights weights,
                                      const WeightVariances& variances);

/// Covariance of (slope, intercept) as the sum of the first-order contributions of range and
/// bearing noise of each point, in both coordinates and in the weights.
[[nodiscard]] Symmetric2 axis_covariance(const PointsView& points, AxisWeights weights,
                                         const AxisRegression& fit, const SensorModel& sensor);

/// Covariance of (alpha, r) from that of (slope, intercept).
[[nodiscard]] Eigen::Matrix2d to_normal_form(const AxisRegression& fit,
                                             const Symmetric2& covariance);

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
