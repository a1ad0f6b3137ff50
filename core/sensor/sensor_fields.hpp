// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Where line fitting takes the noise of the sensor from.
enum class NoiseOrigin {
  declared,   ///< what the source says
  estimated,  ///< the last scans, as soon as they show it; what the source says before
};

template <>
struct EnumNames<NoiseOrigin> {
  static constexpr std::array<std::pair<NoiseOrigin, std::string_view>, 2> names{
      {{NoiseOrigin::declared, "declared"}, {NoiseOrigin::estimated, "estimated"}}};
};

/// What a source says of its sensor.
struct SensorDeclaration : SensorModel {
  NoiseOrigin noise = NoiseOrigin::declared;
};

/// Description of a sensor declaration, for the parameters `P` of a source, which derive from it:
/// they are what the source declares of its sensor in each scan.
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
                       "share"),
      field<P, NoiseOrigin>(&P::noise, "noise",
                            "declared: these figures are the noise; estimated: line fitting begins "
                            "with them and learns the noise from the scans")};
}

namespace detail {
struct SensorParameters : SensorDeclaration {
  static constexpr auto fields() { return sensor_fields<SensorParameters>(); }
};
}  // namespace detail

/// What a source that measures can declare.
[[nodiscard]] inline std::vector<ParameterInfo> sensor_parameters() {
  return describe_parameters<detail::SensorParameters>();
}

}  // namespace quoin
