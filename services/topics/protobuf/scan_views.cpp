// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/scan_views.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "services/topics/protobuf/scene.hpp"
#include "services/topics/segments.hpp"

namespace quoin::topics {

namespace {

template <class Message>
void begin(const msg::Header& header, Message& out) {
  set_time(header.stamp(), *out.mutable_timestamp());
  out.set_frame_id(header.frame());
  set_pose({}, *out.mutable_pose());
}

/// Fields of a point, of four bytes each.
void set_fields(std::initializer_list<const char*> names, foxglove::PointCloud& out) {
  for (const char* name : names) {
    foxglove::PackedElementField& field = *out.add_fields();
    field.set_name(name);
    field.set_offset(4U * static_cast<std::uint32_t>(out.fields_size() - 1));
    field.set_type(foxglove::PackedElementField::FLOAT32);
  }
  out.set_point_stride(4U * static_cast<std::uint32_t>(out.fields_size()));
}

void add_point(float bearing, float range, std::string& data) {
  const float values[3] = {range * std::cos(bearing), range * std::sin(bearing), 0.0F};
  data.append(reinterpret_cast<const char*>(values), sizeof values);
}

void add_value(float value, std::string& data) {
  data.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

bool show_rays(const msg::Scan& scan, foxglove::LaserScan& out) {
  const std::vector<float>& bearings = scan.bearings();
  if (bearings.size() < 2 || scan.ranges().size() != bearings.size()) return false;
  const double first = bearings.front();
  const double step = (bearings.back() - first) / static_cast<double>(bearings.size() - 1);
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const double off = bearings[i] - (first + static_cast<double>(i) * step);
    if (!(std::abs(off) <= 0.1 * std::abs(step))) return false;  // NaN, too
  }
  begin(scan.header(), out);
  out.set_start_angle(first);
  out.set_end_angle(bearings.back());
  out.mutable_ranges()->Add(scan.ranges().begin(), scan.ranges().end());
  out.mutable_intensities()->Add(scan.qualities().begin(), scan.qualities().end());
  return true;
}

bool show_points(const msg::Scan& scan, foxglove::PointCloud& out) {
  if (scan.ranges().size() != scan.bearings().size()) return false;
  begin(scan.header(), out);
  const bool qualities = scan.qualities().size() == scan.ranges().size() && !scan.ranges().empty();
  if (qualities) {
    set_fields({"x", "y", "z", "quality"}, out);
  } else {
    set_fields({"x", "y", "z"}, out);
  }
  std::string& data = *out.mutable_data();
  for (std::size_t i = 0; i < scan.ranges().size(); ++i) {
    if (!std::isfinite(scan.ranges()[i])) continue;
    add_point(scan.bearings()[i], scan.ranges()[i], data);
    if (qualities) add_value(scan.qualities()[i], data);
  }
  return true;
}

bool show_segments(const msg::Segments& message, foxglove::PointCloud& out) {
  if (!valid(message)) return false;
  begin(message.header(), out);
  set_fields({"x", "y", "z", "segment"}, out);
  std::vector<float> numbers(message.ranges().size(), -1.0F);
  for (std::size_t n = 0; n < message.segments().size(); ++n) {
    const msg::IndexRange& range = message.segments()[n];
    for (std::size_t i = range.begin(); i < range.end(); ++i) numbers[i] = static_cast<float>(n);
  }
  for (std::size_t n = 0; n < message.arcs().size(); ++n) {
    const msg::IndexRange& range = message.arcs()[n];
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      numbers[i] = -2.0F - static_cast<float>(n);
    }
  }
  std::string& data = *out.mutable_data();
  for (std::size_t i = 0; i < message.ranges().size(); ++i) {
    add_point(message.bearings()[i], message.ranges()[i], data);
    add_value(numbers[i], data);
  }
  return true;
}

}  // namespace quoin::topics
