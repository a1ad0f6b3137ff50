// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <gmock/gmock.h>

#include "core/geometry/angle.hpp"
#include "core/geometry/line.hpp"

namespace quoin {

/// Same direction of the normal (modulo a turn) and same distance.
MATCHER_P3(LineNear, alpha, r, tolerance, "") {
  *result_listener << "alpha " << arg.alpha << ", r " << arg.r;
  return std::abs(normalized_angle(arg.alpha - alpha)) <= tolerance &&
         std::abs(arg.r - r) <= tolerance;
}

/// Equal up to `relative` times the root of the diagonal elements of the expected matrix.
MATCHER_P2(CovarianceNear, expected, relative, "") {
  const Eigen::Matrix2d e = expected;
  *result_listener << "\n" << arg << "\nagainst\n" << e;
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) {
      const double scale = std::sqrt(e(i, i) * e(k, k));
      if (!(std::abs(arg(i, k) - e(i, k)) <= relative * scale)) return false;
    }
  }
  return true;
}

}  // namespace quoin
