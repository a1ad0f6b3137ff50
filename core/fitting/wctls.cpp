// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/wctls.hpp"

#include "core/fitting/inverse_range_regression.hpp"

namespace quoin {

FitResult Wctls::operator()(const PointsView& points, const SensorModel& sensor) const {
  // q = (A, B) = (x_Q, -y_Q): the signs cancel in (alpha, r), see to_normal_form.
  return fit_inverse_range(points, sensor,
                           parameters_.covariance == CovarianceMode::as_published
                               ? CountedErrors::independent
                               : CountedErrors::independent_and_bias);
}

}  // namespace quoin
