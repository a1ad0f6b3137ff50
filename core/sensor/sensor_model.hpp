// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace quoin {

/// Standard deviations of a 2D LiDAR. Noise is independent from ray to ray and averages out; bias
/// is common to all rays of a scan and does not, so the two are kept apart.
struct SensorModel {
  double range_stddev = 0.010;  ///< [m] noise of each range
  double bearing_stddev =
      0.00197;  ///< [rad] noise of each bearing (0.113 deg: 0.391 deg steps, uniform)
  double range_bias_stddev = 0.0;  ///< [m] error common to all ranges; 0 when unknown or calibrated
};

}  // namespace quoin
