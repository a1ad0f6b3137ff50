// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/fitting/symmetric2.hpp"

namespace quoin {

/// Covariance of (alpha, r) from that of (alpha, offset of the line at a point), where t is the
/// coordinate of that point along the line [m]: r = offset + t d(alpha).
[[nodiscard]] inline Eigen::Matrix2d from_offset_at_mean(const Symmetric2& covariance, double t) {
  Eigen::Matrix2d result;
  result(0, 0) = covariance.xx;
  result(0, 1) = covariance.xy + t * covariance.xx;
  result(1, 0) = result(0, 1);
  result(1, 1) = covariance.yy + 2.0 * t * covariance.xy + t * t * covariance.xx;
  return result;
}

}  // namespace quoin
