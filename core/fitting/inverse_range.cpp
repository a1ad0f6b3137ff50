// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/inverse_range.hpp"

#include "core/fitting/inverse_range_regression.hpp"
#include "core/fitting/normal_residuals.hpp"

namespace quoin {

FitResult InverseRange::operator()(const PointsView& points, const SensorModel& sensor) const {
  constexpr int steps = 2;
  constexpr double longest_last_step = 0.25;  // standard deviations, squared
  InverseLine start;
  const FitFailure failure = solve_inverse_range(points, start);
  if (failure != FitFailure::none) return FitResult::failed(failure);
  const WeightVariances variances(sensor);
  const double scale = 1.0 / start.q.norm();
  AnchoredLine line{
      {0.5 * (points.x.front() + points.x.back()), 0.5 * (points.y.front() + points.y.back())},
      start.q * scale};
  line.offset = scale - line.normal.dot(line.anchor);
  for (int step = 1;; ++step) {
    const NormalResiduals sums = normal_residuals(points, line, variances);
    const auto change = solve_inverse_line(sums.information, sums.descent_x, sums.descent_y);
    if (!change) return FitResult::failed(reason_of_singularity(points));
    line = line.moved(change->q);
    if (step < steps) continue;
    // Near the sensor, for the noise of the bearings, the regression is too far off to start from.
    const double length = change->q.x() * sums.descent_x + change->q.y() * sums.descent_y;
    if (!(length <= longest_last_step)) return FitResult::failed(FitFailure::through_sensor);
    return fitted(line, sums);
  }
}

}  // namespace quoin
