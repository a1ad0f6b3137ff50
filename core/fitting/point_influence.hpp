// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/symmetric2.hpp"

namespace quoin {

/// First-order influence of the range error and the bearing error of one point on two quantities x
/// and y.
struct PointInfluence {
  double range_x = 0.0;
  double range_y = 0.0;
  double bearing_x = 0.0;
  double bearing_y = 0.0;

  PointInfluence& operator+=(const PointInfluence& other) {
    range_x += other.range_x;
    range_y += other.range_y;
    bearing_x += other.bearing_x;
    bearing_y += other.bearing_y;
    return *this;
  }
};

/// Adds what the noise of the point contributes to the covariance of (x, y).
inline void add_noise(Symmetric2& covariance, const PointInfluence& p, double range_variance,
                      double bearing_variance) {
  covariance.xx +=
      range_variance * p.range_x * p.range_x + bearing_variance * p.bearing_x * p.bearing_x;
  covariance.xy +=
      range_variance * p.range_x * p.range_y + bearing_variance * p.bearing_x * p.bearing_y;
  covariance.yy +=
      range_variance * p.range_y * p.range_y + bearing_variance * p.bearing_y * p.bearing_y;
}

}  // namespace quoin
