// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Scan.h>

#include "core/sensor/sensor_fields.hpp"

namespace quoin::sensor_bridge {

/// A scan message without rays, filled with what a source declares of its sensor in `parameters`;
/// for reuse from scan to scan.
template <class Parameters>
[[nodiscard]] msg::Scan declared_scan(const Parameters& parameters) {
  msg::Scan scan;
  scan.header().frame(parameters.frame);
  scan.sensor_model().range_stddev(parameters.range_stddev);
  scan.sensor_model().bearing_stddev(parameters.bearing_stddev);
  scan.sensor_model().range_bias_stddev(parameters.range_bias_stddev);
  scan.sensor_model().range_stddev_per_metre(parameters.range_stddev_per_metre);
  scan.sensor_model().flatness_stddev(parameters.flatness_stddev);
  scan.sensor_model().estimated(parameters.noise == NoiseOrigin::estimated);
  scan.range_min(static_cast<float>(parameters.range_min));
  scan.range_max(static_cast<float>(parameters.range_max));
  return scan;
}

}  // namespace quoin::sensor_bridge
