// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "core/corners/corner_finder.hpp"
#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Corners of lines that follow each other in the scan and meet where both end: within a few rays
/// of the sensor, which may be far apart where they graze a wall, or within distances in metres.
class Adjacent {
 public:
  static constexpr const char* name = "adjacent";
  static constexpr const char* description = "intersections of neighbouring lines";
  static constexpr const char* source = "Prieto-Fernandez et al. 2026, eq. 24-25";
  static constexpr const char* choose =
      "For corners whose two walls are seen up to the corner or nearly so; it is the only corner "
      "finder. Raise max_gap and max_extrapolation when something stands in front of the corner: "
      "each is a guess that the walls go on.";

  struct Parameters {
    double min_angle = 0.3490658503988659;  // [rad] 20 deg
    double max_gap = 0.30;                  // [m]
    double max_extrapolation = 0.30;        // [m]
    bool include_range_bias = true;

    static constexpr auto fields() {
      return std::make_tuple(
          field(&Parameters::min_angle, "min_angle", "rad", 0.01, 1.57,
                "lines that meet at a smaller angle make no corner"),
          field(&Parameters::max_gap, "max_gap", "m", 0.0, 100.0,
                "largest distance between the facing ends of two lines that are not seen "
                "up to their corner"),
          field(&Parameters::max_extrapolation, "max_extrapolation", "m", 0.0, 100.0,
                "largest distance from such an end to the corner"),
          field(&Parameters::include_range_bias, "include_range_bias",
                "add the sensor's range bias to the covariance of each corner"));
    }
  };

  Adjacent() : Adjacent(Parameters{}) {}
  explicit Adjacent(const Parameters& parameters);

  void operator()(std::span<const LineSegment> lines, double range_bias_stddev,
                  FoundCorners& found);

 private:
  /// The corner of two lines, or why there is none.
  [[nodiscard]] std::optional<NoCornerReason> find(std::span<const LineSegment> lines,
                                                   std::size_t first, std::size_t second,
                                                   Corner& corner) const;

  Parameters parameters_;
  double sine_of_min_angle_ = 0.0;
  Points normals_;                 // x and y of the unit normals of the lines
  std::vector<double> ray_steps_;  // of the lines [rad]
};

}  // namespace quoin
