// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/maximum_likelihood.hpp"

#include "core/fitting/inverse_range_regression.hpp"
#include "core/fitting/radial_step.hpp"

namespace quoin {

FitResult MaximumLikelihood::operator()(const PointsView& points, const SensorModel& sensor) const {
  constexpr int most_iterations = 50;
  // A ten-millionth of a standard deviation.
  constexpr double small_step = 1e-14;
  InverseLine line;
  const FitFailure failure = solve_inverse_range(points, line);
  if (failure != FitFailure::none) return FitResult::failed(failure);
  const WeightVariances variances(sensor);
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    const RadialStep step = radial_step(points, line.q, variances);
    if (step.failure != FitFailure::none) return FitResult::failed(step.failure);
    line = step.line;
    if (step.squared_length <= small_step || step.smaller_than_rounding) {
      FitResult result = to_normal_form(line, step.information);
      if (result.ok()) result.iterations = iteration;
      return result;
    }
  }
  return FitResult::failed(FitFailure::not_converged);
}

}  // namespace quoin
