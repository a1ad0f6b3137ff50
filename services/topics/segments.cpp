// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/segments.hpp"

#include <algorithm>
#include <limits>

namespace quoin::topics {
namespace {

void fill_ranges(const std::vector<Segment>& runs, std::vector<msg::IndexRange>& out) {
  out.resize(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    out[i].begin(static_cast<std::uint32_t>(runs[i].begin));
    out[i].end(static_cast<std::uint32_t>(runs[i].end));
  }
}

}  // namespace

SensorModel sensor_model(const msg::SensorModel& message) {
  // A range travels as a float, which is rounded: no sensor has less noise than that.
  constexpr double rounding = 0.5 * std::numeric_limits<float>::epsilon();
  return {message.range_stddev(), message.bearing_stddev(), message.range_bias_stddev(),
          std::max(message.range_stddev_per_metre(), rounding), message.flatness_stddev()};
}

msg::SensorModel sensor_model_message(const SensorModel& model) {
  msg::SensorModel message;
  message.range_stddev(model.range_stddev);
  message.bearing_stddev(model.bearing_stddev);
  message.range_bias_stddev(model.range_bias_stddev);
  message.range_stddev_per_metre(model.range_stddev_per_metre);
  message.flatness_stddev(model.flatness_stddev);
  return message;
}

void fill_segments(const msg::Scan& scan, const Points& points, const Segmentation& found,
                   msg::Segments& out) {
  out.sensor_model(scan.sensor_model());
  out.scan_points(static_cast<std::uint32_t>(scan.ranges().size()));
  out.bearings().assign(points.bearing.begin(), points.bearing.end());
  out.ranges().assign(points.range.begin(), points.range.end());
  fill_ranges(found.segments, out.segments());
  fill_ranges(found.arcs, out.arcs());
  out.set_aside(static_cast<std::uint32_t>(found.foreign.size()));
  out.no_return(static_cast<std::uint32_t>(found.no_return));
}

bool valid(const msg::Segments& message) {
  if (message.bearings().size() != message.ranges().size()) return false;
  const auto inside = [&](const msg::IndexRange& range) {
    return range.begin() <= range.end() && range.end() <= message.ranges().size();
  };
  return message.set_aside() <= message.ranges().size() &&
         std::all_of(message.segments().begin(), message.segments().end(), inside) &&
         std::all_of(message.arcs().begin(), message.arcs().end(), inside);
}

}  // namespace quoin::topics
