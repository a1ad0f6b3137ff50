// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/symmetric2.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// First and second moments of the points, the second about the mean.
struct Moments {
  double weight = 0.0;  ///< sum of the weights; the number of points when they are equal
  double mean_x = 0.0;  ///< [m]
  double mean_y = 0.0;  ///< [m]
  Symmetric2 spread;    ///< weighted sums of the products of (x, y) about the mean

  [[nodiscard]] double trace() const { return spread.xx + spread.yy; }

  /// Whether the points lie apart by more than rounding leaves of equal ones.
  [[nodiscard]] bool have_extent() const {
    return trace() > 1e-18 * weight * (mean_x * mean_x + mean_y * mean_y);
  }
};

enum class PointWeights {
  equal,
  inverse_square_range,  ///< 1 / range^2 [1/m^2]
};

/// At least one point.
[[nodiscard]] Moments moments_of(const PointsView& points, PointWeights weights);

}  // namespace quoin
