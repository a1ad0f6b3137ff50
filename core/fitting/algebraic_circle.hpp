// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/fitting/circle.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// By what the squares of A (x^2 + y^2) + B x + C y + D are divided, so that A = B = C = D = 0 is
/// no solution.
enum class CircleConstraint {
  taubin,  ///< the mean squared gradient (Taubin 1991)
  pratt,   ///< B^2 + C^2 - 4 A D, which is 4 A^2 radius^2 (Pratt 1987)
  hyper,   ///< twice that of Taubin less that of Pratt (Al-Sharadqah and Chernov 2009)
};

/// Circle for which the sum over the points of (A (x^2 + y^2) + B x + C y + D)^2 under the
/// constraint is least: the generalised eigenvector of the smallest positive eigenvalue. Nothing
/// for fewer than three points or when they do not determine a circle, such as on a line.
[[nodiscard]] std::optional<Circle> fit_algebraic_circle(const PointsView& points,
                                                         CircleConstraint constraint);

}  // namespace quoin
