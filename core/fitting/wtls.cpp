// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/wtls.hpp"

#include "core/fitting/inverse_range_regression.hpp"

namespace quoin {

FitResult Wtls::operator()(const PointsView& points, const SensorModel& sensor) const {
  return fit_inverse_range(points, sensor,
                           parameters_.covariance == CovarianceMode::as_published
                               ? CountedErrors::common
                               : CountedErrors::independent_and_bias);
}

}  // namespace quoin
