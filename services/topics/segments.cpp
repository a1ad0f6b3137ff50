// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/segments.hpp"

namespace quoin::topics {

SensorModel sensor_model(const msg::SensorModel& message) {
  return {message.range_stddev(), message.bearing_stddev(), message.range_bias_stddev()};
}

msg::SensorModel sensor_model_message(const SensorModel& model) {
  msg::SensorModel message;
  message.range_stddev(model.range_stddev);
  message.bearing_stddev(model.bearing_stddev);
  message.range_bias_stddev(model.range_bias_stddev);
  return message;
}

void fill_segments(const msg::Scan& scan, const Points& points,
                   const std::vector<Segment>& segments, msg::Segments& out) {
  out.sensor_model(scan.sensor_model());
  out.scan_points(static_cast<std::uint32_t>(scan.ranges().size()));
  out.bearings().assign(points.bearing.begin(), points.bearing.end());
  out.ranges().assign(points.range.begin(), points.range.end());
  out.segments().resize(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    out.segments()[i].begin(static_cast<std::uint32_t>(segments[i].begin));
    out.segments()[i].end(static_cast<std::uint32_t>(segments[i].end));
  }
}

bool valid(const msg::Segments& message) {
  if (message.bearings().size() != message.ranges().size()) return false;
  for (const msg::IndexRange& range : message.segments()) {
    if (range.begin() > range.end() || range.end() > message.ranges().size()) return false;
  }
  return true;
}

}  // namespace quoin::topics
