// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/markers.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "core/geometry/angle.hpp"
#include "services/topics/segments.hpp"

namespace quoin::ros2 {

namespace {

using Color = std_msgs::msg::dds_::ColorRGBA_;
using Place = geometry_msgs::msg::dds_::Point_;

// Of visualization_msgs/Marker.
constexpr std::int32_t line_list = 5;
constexpr std::int32_t points = 8;
constexpr std::int32_t add = 0;
constexpr std::int32_t take_away = 2;

constexpr int ellipse_sides = 24;
constexpr int circle_sides = 36;

// Told apart by all who see colors otherwise, on dark and on light ground (Okabe and Ito 2008).
constexpr std::array<std::array<float, 3>, 7> palette{{{0.90F, 0.62F, 0.00F},
                                                       {0.34F, 0.71F, 0.91F},
                                                       {0.00F, 0.62F, 0.45F},
                                                       {0.94F, 0.89F, 0.26F},
                                                       {0.00F, 0.45F, 0.70F},
                                                       {0.84F, 0.37F, 0.00F},
                                                       {0.80F, 0.47F, 0.65F}}};

Color color_of(std::size_t number) {
  const auto& rgb = palette[number % palette.size()];
  Color color;
  color.r(rgb[0]);
  color.g(rgb[1]);
  color.b(rgb[2]);
  color.a(1.0F);
  return color;
}

Color grey() {
  Color color;
  color.r(0.6F);
  color.g(0.6F);
  color.b(0.6F);
  color.a(1.0F);
  return color;
}

Place place(double x, double y) {
  Place point;
  point.x(x);
  point.y(y);
  point.z(0.0);
  return point;
}

/// Fills in markers of `out` one after the other, whose memory it reuses.
class Sheet {
 public:
  Sheet(const msg::Header& header, const MarkerStyle& style, MarkerArray& out)
      : header_(header), style_(style), out_(out) {}
  /// Viewers complain of markers without points.
  ~Sheet() {
    out_.markers().resize(used_);
    for (Marker& marker : out_.markers()) marker.action(marker.points().empty() ? take_away : add);
  }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  /// Its id is how many there were before. `width` [m].
  Marker& next(std::int32_t type, double width) {
    if (out_.markers().size() == used_) out_.markers().emplace_back();
    Marker& marker = out_.markers()[used_];
    set_header(marker.header(), header_.stamp(), header_.frame());
    marker.ns(style_.ns);
    marker.id(static_cast<std::int32_t>(used_++));
    marker.type(type);
    marker.pose().orientation().w(1.0);
    marker.scale().x(width);
    marker.scale().y(width);
    marker.color(color_of(style_.color));
    const double whole = std::floor(style_.lifetime);
    marker.lifetime().sec(static_cast<std::int32_t>(whole));
    marker.lifetime().nanosec(static_cast<std::uint32_t>((style_.lifetime - whole) * 1e9));
    marker.points().clear();
    marker.colors().clear();
    return marker;
  }

 private:
  const msg::Header& header_;
  const MarkerStyle& style_;
  MarkerArray& out_;
  std::size_t used_ = 0;
};

void add_line(const Place& from, const Place& to, Marker& marker) {
  marker.points().push_back(from);
  marker.points().push_back(to);
}

/// A closed polygon whose corner number i of `sides` is `at(i)`.
template <class At>
void add_polygon(int sides, At at, Marker& marker) {
  Place before = at(0);
  for (int i = 1; i <= sides; ++i) {
    const Place next = at(i % sides);
    add_line(before, next, marker);
    before = next;
  }
}

void add_ellipse(const msg::Corner& corner, Marker& marker) {
  const double c = std::cos(corner.ellipse95_direction());
  const double s = std::sin(corner.ellipse95_direction());
  add_polygon(
      ellipse_sides,
      [&](int side) {
        const double angle = 2.0 * pi * side / ellipse_sides;
        const double u = corner.ellipse95_major() * std::cos(angle);
        const double v = corner.ellipse95_minor() * std::sin(angle);
        return place(corner.x() + c * u - s * v, corner.y() + s * u + c * v);
      },
      marker);
}

}  // namespace

void fill_markers(const msg::Segments& in, const MarkerStyle& style, MarkerArray& out) {
  Sheet sheet(in.header(), style, out);
  Marker& marker = sheet.next(points, style.width);
  if (!topics::valid(in)) return;
  marker.colors().assign(in.ranges().size(), grey());
  for (std::size_t i = 0; i < in.ranges().size(); ++i) {
    const double range = static_cast<double>(in.ranges()[i]);
    const double bearing = static_cast<double>(in.bearings()[i]);
    marker.points().push_back(place(range * std::cos(bearing), range * std::sin(bearing)));
  }
  for (std::size_t k = 0; k < in.segments().size(); ++k) {
    const msg::IndexRange& range = in.segments()[k];
    for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
      marker.colors()[i] = color_of(style.color + k);
    }
  }
}

void fill_markers(const msg::Lines& in, const MarkerStyle& style, MarkerArray& out) {
  Sheet sheet(in.header(), style, out);
  Marker& marker = sheet.next(line_list, style.width);
  for (const msg::Line& line : in.lines()) {
    add_line(place(line.start().x(), line.start().y()), place(line.end().x(), line.end().y()),
             marker);
  }
}

void fill_markers(const msg::Corners& in, const MarkerStyle& style, MarkerArray& out) {
  Sheet sheet(in.header(), style, out);
  Marker& positions = sheet.next(points, 2.0 * style.width);
  for (const msg::Corner& corner : in.corners()) {
    positions.points().push_back(place(corner.x(), corner.y()));
  }
  Marker& ellipses = sheet.next(line_list, 0.3 * style.width);
  for (const msg::Corner& corner : in.corners()) add_ellipse(corner, ellipses);
}

void fill_markers(const msg::Circles& in, const MarkerStyle& style, MarkerArray& out) {
  const auto on = [](const msg::Circle& circle, double angle) {
    return place(circle.x() + circle.radius() * std::cos(angle),
                 circle.y() + circle.radius() * std::sin(angle));
  };
  Sheet sheet(in.header(), style, out);
  Marker& whole = sheet.next(line_list, 0.3 * style.width);
  for (const msg::Circle& circle : in.circles()) {
    add_polygon(
        circle_sides, [&](int side) { return on(circle, 2.0 * pi * side / circle_sides); }, whole);
  }
  Marker& seen = sheet.next(line_list, style.width);
  for (const msg::Circle& circle : in.circles()) {
    const double step = (circle.arc_end() - circle.arc_start()) / circle_sides;
    for (int side = 0; side < circle_sides; ++side) {
      add_line(on(circle, circle.arc_start() + step * side),
               on(circle, circle.arc_start() + step * (side + 1)), seen);
    }
  }
}

void fill_markers(std::span<const MapLine> walls, const msg::Header& header,
                  const MarkerStyle& style, MarkerArray& out) {
  Sheet sheet(header, style, out);
  Marker& marker = sheet.next(line_list, style.width);
  for (const MapLine& wall : walls) {
    add_line(place(wall.start.x(), wall.start.y()), place(wall.end.x(), wall.end.y()), marker);
  }
}

}  // namespace quoin::ros2
