// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "core/fitting/fit.hpp"
#include "core/fitting/inverse_line.hpp"

namespace quoin {

/// Sums of the regression of the inverse range on (cos, sin) of the bearing. The line A x + B y = 1
/// reads A cos + B sin = 1 / range, and the algebraic fit with the weights of WCTLS eq. (8) is this
/// regression with equal weights: sigma_rho and sigma_theta cancel.
struct InverseRangeSums {
  double cc = 0.0;
  double cs = 0.0;
  double ss = 0.0;
  double cz = 0.0;  ///< [1/m] cosine times inverse range
  double sz = 0.0;  ///< [1/m]

  InverseRangeSums& operator+=(const InverseRangeSums& other) {
    cc += other.cc;
    cs += other.cs;
    ss += other.ss;
    cz += other.cz;
    sz += other.sz;
    return *this;
  }
};

/// Of points [begin, end).
[[nodiscard]] InverseRangeSums inverse_range_sums(const PointsView& points, std::size_t begin,
                                                  std::size_t end);

/// Sum over the points of the outer products of their exact first-order influences on M q: the
/// covariance of q = (A, B) once multiplied by M^-1 from both sides. The line is that of the
/// points.
[[nodiscard]] Symmetric2 inverse_range_influence(const PointsView& points, const InverseLine& line,
                                                 const SensorModel& sensor);

/// The same if one range error and one bearing error were common to all points: the outer products
/// of the summed influences. This is WCTLS eq. (13) with a Jacobian of two columns.
[[nodiscard]] Symmetric2 inverse_range_common_influence(const PointsView& points,
                                                        const Eigen::Vector2d& q,
                                                        const SensorModel& sensor);

/// The line of the regression alone; fails by name and leaves `line` as it was.
[[nodiscard]] FitFailure solve_inverse_range(const PointsView& points, InverseLine& line);

/// What the covariance of the algebraic fit counts.
enum class CountedErrors {
  independent_and_bias,  ///< of each point by itself, and the bias by the noise of the bearings
  independent,           ///< of each point by itself
  common,                ///< one range error and one bearing error of all points
};

/// The fit shared by WTLS and WCTLS, which differ in what they publish as covariance.
[[nodiscard]] FitResult fit_inverse_range(const PointsView& points, const SensorModel& sensor,
                                          CountedErrors counted);

}  // namespace quoin
