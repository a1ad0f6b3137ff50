// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/parameters.hpp"

#include <algorithm>
#include <numbers>

#include "sensor_bridge/range_limits.hpp"

namespace quoin::sensor_bridge {

ScannerSettings scanner_settings(const SimulatedParameters& parameters) {
  check_range_limits(parameters);
  ScannerSettings settings;
  settings.points = static_cast<std::size_t>(parameters.points);
  // The limit of the parameter is 2 pi rounded up, so that 6.2832 is valid.
  settings.field_of_view = std::min(parameters.field_of_view, 2.0 * std::numbers::pi);
  settings.first_bearing = -0.5 * settings.field_of_view;
  settings.period = 1.0 / parameters.rate_hz;
  settings.range_min = parameters.range_min;
  settings.range_max = parameters.range_max;
  settings.noise = parameters;
  settings.range_bias = parameters.range_bias;
  settings.dropout = parameters.dropout;
  return settings;
}

WheelErrors wheel_errors(const SimulatedParameters& parameters) {
  WheelErrors errors{parameters.wheel_slip, parameters.wheel_heading_bias, {}};
  OdometryNoise& noise = errors.noise;
  for (double* stddev :
       {&noise.translation_per_metre, &noise.sideways_per_metre, &noise.heading_per_metre,
        &noise.heading_per_radian, &noise.translation_floor, &noise.heading_floor}) {
    *stddev *= parameters.wheel_noise;
  }
  // At rest wheels count nothing.
  noise.translation_floor = 0.0;
  noise.heading_floor = 0.0;
  return errors;
}

}  // namespace quoin::sensor_bridge
