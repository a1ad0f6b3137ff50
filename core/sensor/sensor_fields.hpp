// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tuple>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Description of a sensor model, for the parameters `P` of a source, which derive from it: they
/// are what the source declares of its sensor in each scan.
template <class P>
[[nodiscard]] constexpr auto sensor_fields() {
  return std::tuple{
      field<P, double>(&P::range_stddev, "range_stddev", "m", 0.0, 1.0,
                       "noise of each range that does not depend on the range"),
      field<P, double>(&P::range_stddev_per_metre, "range_stddev_per_metre", "m/m", 0.0, 0.5,
                       "noise of each range that grows with it, 1 % for 10 mm at 1 m; both add up "
                       "as squares"),
      field<P, double>(&P::bearing_stddev, "bearing_stddev", "rad", 0.0, 0.1,
                       "noise of each bearing"),
      field<P, double>(&P::range_bias_stddev, "range_bias_stddev", "m", 0.0, 1.0,
                       "error common to all ranges, by its standard deviation; 0 when unknown"),
      field<P, double>(&P::flatness_stddev, "flatness_stddev", "m", 0.0, 1.0,
                       "how far walls are off a line by themselves, over lengths that many rays "
                       "share")};
}

namespace detail {
struct SensorParameters : SensorModel {
  static constexpr auto fields() { return sensor_fields<SensorParameters>(); }
};
}  // namespace detail

/// What a source that measures can declare.
[[nodiscard]] inline std::vector<ParameterInfo> sensor_parameters() {
  return describe_parameters<detail::SensorParameters>();
}

}  // namespace quoin
