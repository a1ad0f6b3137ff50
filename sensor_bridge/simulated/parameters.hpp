// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/parameters/parameter.hpp"
#include "core/sensor/sensor_fields.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin::sensor_bridge {

/// Parameters of the simulated sensor. It has the noise of range and bearing that it declares. The
/// defaults are an RPLIDAR S1 at 10 Hz: 9200 samples a second, range noise of 1 cm, bearings in
/// steps of 0.391 deg.
struct SimulatedParameters : SensorDeclaration {
  std::string environment = "domestic_room";
  double rate_hz = 10.0;                     ///< [Hz]
  std::int64_t points = 920;                 ///< rays per revolution
  std::int64_t seed = 1;                     ///< same seed, same scans
  double speed = 0.0;                        ///< [m/s]
  std::int64_t scans = 0;                    ///< 0: endless
  double field_of_view = 6.283185307179586;  ///< [rad]
  double range_min = 0.1;                    ///< [m]
  double range_max = 40.0;                   ///< [m]
  double range_bias = 0.0;                   ///< [m]
  double dropout = 0.0;                      ///< probability
  std::string frame = "laser";

  static constexpr auto fields() {
    using P = SimulatedParameters;
    const std::tuple own{
        field(
            &P::environment, "environment",
            "name of a built-in world, or path of a world file (relative to the deployment file)"),
        field(&P::rate_hz, "rate_hz", "Hz", 0.1, 1000.0, "revolutions a second"),
        field(&P::points, "points", "", 3.0, 100000.0, "rays per revolution"),
        // 2^53: larger integers do not survive a double, which YAML and JSON readers may use.
        field(&P::seed, "seed", "", 0.0, 9007199254740992.0, "seed of the noise"),
        field(&P::speed, "speed", "m/s", 0.0, 100.0,
              "speed along the world's path, there and back"),
        field(&P::scans, "scans", "", 0.0, 9007199254740992.0,
              "scans to publish before ending; 0 never ends"),
        field(&P::field_of_view, "field_of_view", "rad", 0.001, 6.2832,
              "swept angle, centred on the x axis"),
        field(&P::range_min, "range_min", "m", 0.0, 1000.0, "shortest range that is measured"),
        field(&P::range_max, "range_max", "m", 0.01, 10000.0, "longest range that is measured"),
        field(&P::range_bias, "range_bias", "m", -1.0, 1.0, "error that is added to every range"),
        field(&P::dropout, "dropout", "", 0.0, 1.0, "probability that a ray gives no range"),
        field(&P::frame, "frame", "frame of the sensor (REP-105)")};
    return std::tuple_cat(own, sensor_fields<P>());
  }
};

/// The scanner that `parameters` describe. Throws ParameterError when they contradict each other.
[[nodiscard]] ScannerSettings scanner_settings(const SimulatedParameters& parameters);

}  // namespace quoin::sensor_bridge
