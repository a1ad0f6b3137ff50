// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "core/parameters/parameter.hpp"

namespace quoin::sensor_bridge {

/// How a sensor is mounted in its frame: parameters of each source, which derive theirs from it.
struct Mounting {
  double angle_offset = 0.0;  ///< [rad] bearing of the sensor's own zero, counter-clockwise from x
  bool inverted = false;      ///< upside down: the sensor's angles run the other way round
};

template <class P>
[[nodiscard]] constexpr auto mounting_fields() {
  return std::tuple{
      field<P, double>(&P::angle_offset, "angle_offset", "rad", -2.0 * std::numbers::pi,
                       2.0 * std::numbers::pi,
                       "bearing of the sensor's own zero, counter-clockwise from x of the frame"),
      field<P, bool>(&P::inverted, "inverted", "the sensor is mounted upside down")};
}

/// Of a bearing [rad] of the sensor, in the frame: (-pi, pi].
[[nodiscard]] inline float mounted(const Mounting& mounting, float bearing) {
  if (mounting.angle_offset == 0.0) {
    return mounting.inverted && bearing != std::numbers::pi_v<float> ? -bearing : bearing;
  }
  const double turned = (mounting.inverted ? -bearing : bearing) + mounting.angle_offset;
  const auto wrapped = static_cast<float>(std::remainder(turned, 2.0 * std::numbers::pi));
  return wrapped <= -std::numbers::pi_v<float> ? std::numbers::pi_v<float> : wrapped;
}

/// The same of all bearings of a scan.
inline void mount(const Mounting& mounting, std::vector<float>& bearings) {
  if (mounting.angle_offset == 0.0 && !mounting.inverted) return;
  for (float& bearing : bearings) bearing = mounted(mounting, bearing);
}

}  // namespace quoin::sensor_bridge
