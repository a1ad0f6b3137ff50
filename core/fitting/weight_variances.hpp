// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "core/sensor/sensor_model.hpp"

namespace quoin {

/// Variances of range [m^2] and bearing [rad^2] to weight points with. A sensor model may say that
/// there is no noise; a range is never taken to be better than a micrometre nor a bearing than a
/// nanoradian, so that the weights stay finite.
struct WeightVariances {
  double range;
  double bearing;

  explicit WeightVariances(const SensorModel& sensor)
      : range(std::max(sensor.range_stddev * sensor.range_stddev, 1e-12)),
        bearing(std::max(sensor.bearing_stddev * sensor.bearing_stddev, 1e-18)) {}
};

}  // namespace quoin
