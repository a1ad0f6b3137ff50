// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/fit.hpp"

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

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const;

 private:
  Parameters parameters_;
};

}  // namespace quoin
