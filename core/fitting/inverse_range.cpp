// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/inverse_range.hpp"

#include "core/fitting/inverse_range_regression.hpp"
#include "core/fitting/radial_step.hpp"

namespace quoin {

FitResult InverseRange::operator()(const PointsView& points, const SensorModel& sensor) const {
  InverseLine line;
  const FitFailure failure = solve_inverse_range(points, line);
  if (failure != FitFailure::none) return FitResult::failed(failure);
  const RadialStep step = radial_step(points, line.q, WeightVariances(sensor));
  if (step.failure != FitFailure::none) return FitResult::failed(step.failure);
  return to_normal_form(step.line, step.information);
}

}  // namespace quoin
