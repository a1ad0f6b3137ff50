// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "core/fitting/fit.hpp"
#include "core/fitting/point_sums.hpp"

namespace quoin {

/// The algebraic fit of A x + B y = 1 minimises the weighted sum of (A x + B y - 1)^2. With equal
/// weights it is UTLS, with 1 / range^2 it is WTLS and WCTLS: in the weights of WCTLS eq. (8)
/// sigma_rho and sigma_theta cancel. The latter is also the regression of the inverse range on
/// (cos, sin) of the bearing, because A x + B y = 1 reads A cos + B sin = 1 / range.
///
/// Its normal equations are M q = v with q = (A, B) = (cos alpha, sin alpha) / r [1/m] and the
/// moments about the sensor, M = (xx, xy, yy) and v = (x, y). det M is -c of WCTLS eq. (4) and
/// (12); it is 0 when all points lie on one ray or are equal.
[[nodiscard]] inline std::optional<Solution2x2> solve_algebraic(const Moments& moments) {
  return solve2x2({moments.xx, moments.xy, moments.yy}, {moments.x, moments.y});
}

[[nodiscard]] inline NormalLine normal_line(const Eigen::Vector2d& q) {
  const double offset = 1.0 / std::sqrt(q.x() * q.x() + q.y() * q.y());
  return {q.x() * offset, q.y() * offset, offset};
}

/// Moments about the sensor of points [begin, end) with the weights 1 / range^2.
[[nodiscard]] Moments inverse_range_moments(const PointsView& points, std::size_t begin,
                                            std::size_t end);

/// q of the fit with these weights; when it fails, `q` is left as it was.
[[nodiscard]] FitFailure find_algebraic_line(const PointsView& points, PointWeights weights,
                                             Eigen::Vector2d& q);

/// Why the normal equations of these points are singular.
[[nodiscard]] FitFailure reason_of_singularity(const PointsView& points);

/// What the covariance of the algebraic fit counts.
enum class CountedErrors {
  independent_and_bias,  ///< of each point by itself, and the bias by the noise of the bearings
  independent,           ///< of each point by itself
  common,                ///< one range error and one bearing error of all points
};

/// The line and its covariance, the fit of UTLS, WTLS and WCTLS.
[[nodiscard]] FitResult fit_algebraic(const PointsView& points, PointWeights weights,
                                      const SensorModel& sensor, CountedErrors counted);

}  // namespace quoin
