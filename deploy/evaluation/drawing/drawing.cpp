// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "deploy/evaluation/drawing/svg.hpp"

namespace quoin::deploy {

namespace {

constexpr double margin = 60.0;
constexpr double header_height = 64.0;
constexpr double legend_height = 84.0;
constexpr double smallest_extent = 1.0;  // [m] so that an empty picture has a scale
constexpr double wanted_ellipse = 18.0;  // semi-major axis in pixels that the eye resolves
constexpr double degrees_per_radian = 57.29577951308232;

bool finite(const DrawnPoint& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

bool finite(const DrawnCorner& corner) {
  return finite(corner.position) && std::isfinite(corner.semi_major) &&
         std::isfinite(corner.semi_minor) && std::isfinite(corner.direction);
}

struct Box {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;  // [m]; the sensor is always inside

  void include(const DrawnPoint& point) {
    if (!finite(point)) return;
    left = std::min(left, point.x);
    right = std::max(right, point.x);
    bottom = std::min(bottom, point.y);
    top = std::max(top, point.y);
  }
};

/// Largest of 1, 2 and 5 times a power of ten that is not above `value`.
double round_step(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= value * (1.0 + 1e-9)) return factor * power;
  }
  return power;
}

/// Smallest of 1, 2 and 5 times a power of ten [m] that keeps grid lines 50 pixels apart.
double grid_step(double pixels_per_metre) {
  const double least = 50.0 / pixels_per_metre;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

/// From the sensor's frame to the picture.
struct Projection {
  Box box;
  double scale = 1.0;  // pixels per metre

  /// `ellipse_scale` is 0 when the ellipses are to follow the size of the picture.
  Projection(const Drawing& drawing, double width, double ellipse_scale) {
    for (const DrawnPoint& point : drawing.points) box.include(point);
    for (const DrawnLine& line : drawing.lines) {
      box.include(line.start);
      box.include(line.end);
    }
    // Corners lie on extrapolated lines; one at the horizon must not shrink everything else.
    for (const DrawnCorner& corner : drawing.corners) {
      if (drawing.points.empty()) box.include(corner.position);
    }
    include_ellipses(drawing, ellipse_scale);
    const double border =
        0.04 * std::max({box.right - box.left, box.top - box.bottom, smallest_extent});
    box.left -= border;
    box.right = std::max(box.right, box.left + smallest_extent) + border;
    box.bottom -= border;
    box.top = std::max(box.top, box.bottom + smallest_extent) + border;
    // Portrait rooms would become endless pages: the height is limited too, and what is left of the
    // width goes to both sides.
    scale = std::min((width - 2.0 * margin) / (box.right - box.left),
                     1.1 * width / (box.top - box.bottom));
    const double spare = (width - 2.0 * margin) / scale - (box.right - box.left);
    box.left -= 0.5 * spare;
    box.right += 0.5 * spare;
  }

  /// Makes room for ellipses of a given scale, at most twice as much as without.
  void include_ellipses(const Drawing& drawing, double ellipse_scale) {
    const Box without = box;
    const double most = 0.5 * std::max(box.right - box.left, box.top - box.bottom);
    for (const DrawnCorner& corner : drawing.corners) {
      const DrawnPoint& at = corner.position;
      if (!finite(corner) || at.x < without.left || at.x > without.right || at.y < without.bottom ||
          at.y > without.top) {
        continue;
      }
      const double c = std::cos(corner.direction), s = std::sin(corner.direction);
      const double dx = ellipse_scale * std::hypot(corner.semi_major * c, corner.semi_minor * s);
      const double dy = ellipse_scale * std::hypot(corner.semi_major * s, corner.semi_minor * c);
      box.include({at.x - std::min(dx, most), at.y - std::min(dy, most)});
      box.include({at.x + std::min(dx, most), at.y + std::min(dy, most)});
    }
  }

  [[nodiscard]] double x(double metres) const { return margin + (metres - box.left) * scale; }
  [[nodiscard]] double y(double metres) const { return header_height + (box.top - metres) * scale; }
  [[nodiscard]] double right() const { return x(box.right); }
  [[nodiscard]] double bottom() const { return y(box.bottom); }
  [[nodiscard]] bool shows(const DrawnPoint& p) const {
    return finite(p) && p.x >= box.left && p.x <= box.right && p.y >= box.bottom && p.y <= box.top;
  }
};

void draw_grid(Svg& svg, const Projection& to, double step) {
  svg.open("g", {{"class", "grid"}});
  const auto first_index = [&](double from) { return static_cast<long>(std::ceil(from / step)); };
  for (long i = first_index(to.box.left); static_cast<double>(i) * step <= to.box.right; ++i) {
    const double metres = static_cast<double>(i) * step;
    svg.line(i == 0 ? "axis" : "minor", to.x(metres), to.y(to.box.top), to.x(metres), to.bottom());
    svg.text("tick middle", to.x(metres), to.bottom() + 16.0, number(metres, 3));
  }
  for (long i = first_index(to.box.bottom); static_cast<double>(i) * step <= to.box.top; ++i) {
    const double metres = static_cast<double>(i) * step;
    svg.line(i == 0 ? "axis" : "minor", to.x(to.box.left), to.y(metres), to.right(), to.y(metres));
    svg.text("tick end", to.x(to.box.left) - 6.0, to.y(metres) + 4.0, number(metres, 3));
  }
  svg.text("tick end", to.right(), to.bottom() + 32.0, "x forward [m]");
  svg.text("tick", 8.0, header_height - 6.0, "y left [m]");
  svg.close("g");
}

void draw_scan(Svg& svg, const Drawing& drawing, const Projection& to) {
  svg.open("g", {{"class", "points"}});
  for (const DrawnPoint& point : drawing.points) {
    if (finite(point)) svg.circle("point", to.x(point.x), to.y(point.y), 1.6);
  }
  svg.close("g");
  svg.open("g", {{"class", "lines"}});
  for (const DrawnLine& line : drawing.lines) {
    if (!finite(line.start) || !finite(line.end)) continue;
    svg.line("fitted", to.x(line.start.x), to.y(line.start.y), to.x(line.end.x), to.y(line.end.y));
  }
  svg.close("g");
}

bool drawn(const DrawnCircle& circle, const Projection& to) {
  return finite(circle.center) && std::isfinite(circle.radius) && to.shows(circle.center.position);
}

/// Those whose centre lies in the picture; a round wall goes on outside of it.
void draw_circles(Svg& svg, const Drawing& drawing, const Projection& to, double ellipse_scale) {
  if (drawing.circles.empty()) return;
  svg.open("g", {{"class", "circles"}});
  for (const DrawnCircle& circle : drawing.circles) {
    if (!drawn(circle, to)) continue;
    const double enlarged = to.scale * ellipse_scale;
    const double x = to.x(circle.center.position.x);
    const double y = to.y(circle.center.position.y);
    svg.circle("round", x, y, circle.radius * to.scale);
    svg.ellipse("center", x, y, circle.center.semi_major * enlarged,
                circle.center.semi_minor * enlarged, -circle.center.direction * degrees_per_radian);
    svg.circle("hub", x, y, 2.0);
  }
  svg.close("g");
}

std::string ellipse_style(std::size_t series) {
  return series == 0 ? "uncertainty"
                     : "uncertainty s" + std::to_string(std::min<std::size_t>(series, 2));
}

/// Returns how many corners lie outside the picture.
std::size_t draw_corners(Svg& svg, const Drawing& drawing, const Projection& to,
                         double ellipse_scale) {
  std::size_t outside = 0;
  svg.open("g", {{"class", drawing.series.empty() ? "corners" : "corners compared"}});
  for (const DrawnCorner& corner : drawing.corners) {
    if (!finite(corner) || !to.shows(corner.position)) {
      ++outside;
      continue;
    }
    const double enlarged = to.scale * ellipse_scale;
    const double x = to.x(corner.position.x);
    const double y = to.y(corner.position.y);
    // SVG's y axis points down, so that its rotations run the other way.
    svg.ellipse(ellipse_style(corner.series), x, y, corner.semi_major * enlarged,
                corner.semi_minor * enlarged, -corner.direction * degrees_per_radian);
    svg.circle("corner", x, y, 2.5);
  }
  svg.close("g");
  return outside;
}

void draw_sensor(Svg& svg, const Projection& to) {
  const double x = to.x(0.0);
  const double y = to.y(0.0);
  svg.open("g", {{"class", "sensor"}});
  svg.circle("sensor", x, y, 6.0);
  svg.line("sensor", x, y, x + 14.0, y);
  svg.close("g");
}

void draw_scale_bar(Svg& svg, const Projection& to, double metres, double y) {
  const double right = to.right();
  const double left = right - metres * to.scale;
  svg.open("g", {{"class", "scale"}});
  svg.line("bar", left, y, right, y);
  svg.line("bar", left, y - 4.0, left, y + 4.0);
  svg.line("bar", right, y - 4.0, right, y + 4.0);
  svg.text("tick middle", 0.5 * (left + right), y - 8.0, number(metres, 3) + " m");
  svg.close("g");
}

void draw_legend(Svg& svg, const Drawing& drawing, double ellipse_scale, std::size_t outside,
                 double y) {
  svg.open("g", {{"class", "legend"}});
  double x = margin;
  const auto entry = [&](const std::string& text) {
    svg.text("legend", x + 14.0, y + 4.0, text);
    x += 30.0 + 7.0 * static_cast<double>(text.size());
  };
  svg.circle("sensor", x, y, 5.0);
  entry("sensor");
  svg.circle("point", x, y, 2.0);
  entry(std::to_string(drawing.points.size()) + " points");
  svg.line("fitted", x - 8.0, y, x + 8.0, y);
  entry(std::to_string(drawing.lines.size()) + " lines");
  if (!drawing.circles.empty()) {
    svg.circle("round", x, y, 7.0);
    svg.circle("hub", x, y, 2.0);
    entry(std::to_string(drawing.circles.size()) + " circles");
  }
  svg.ellipse("uncertainty", x, y, 9.0, 5.0, 0.0);
  svg.circle("corner", x, y, 2.5);
  const std::size_t sets = std::max<std::size_t>(1, drawing.series.size());
  std::string text =
      std::to_string(drawing.corners.size() / sets) + " corners with " + drawing.ellipses + ", ";
  text += ellipse_scale == 1.0 ? "to scale" : "enlarged " + number(ellipse_scale, 3) + " times";
  if (outside > 0) text += " (" + std::to_string(outside) + " outside the picture)";
  entry(text);
  x = margin;
  y += 24.0;
  for (std::size_t k = 0; k < drawing.series.size(); ++k) {
    svg.ellipse(ellipse_style(k), x, y, 9.0, 5.0, 0.0);
    entry(drawing.series[k]);
  }
  svg.close("g");
}

constexpr StyleSheet style{

    "text{font-family:sans-serif;fill:#222}"
    ".title{font-size:17px;font-weight:bold}.caption,.legend{font-size:13px}"
    ".tick{font-size:11px;fill:#666}.middle{text-anchor:middle}.end{text-anchor:end}"
    ".minor{stroke:#e6e6e6}.axis{stroke:#b0b0b0}"
    ".point{fill:#4a6fa5}.fitted{stroke:#e07b00;stroke-width:2;stroke-linecap:round}"
    ".uncertainty{fill:#c62828;fill-opacity:.18;stroke:#c62828;stroke-width:1.2}"
    ".round{fill:none;stroke:#7b1fa2;stroke-width:1.6}"
    ".center{fill:#7b1fa2;fill-opacity:.18;stroke:#7b1fa2;stroke-width:1.2}.hub{fill:#7b1fa2}"
    ".corner{fill:#c62828}.sensor{fill:#2e7d32;stroke:#2e7d32;stroke-width:2}"
    ".compared ellipse{fill-opacity:0;stroke-width:1.8}"
    ".s1{fill:#00695c;stroke:#00897b;stroke-dasharray:7 3}"
    ".s2{fill:#1565c0;stroke:#1e6fd0;stroke-dasharray:2 2}"
    ".bar{stroke:#222;stroke-width:1.5}",
    ".background{fill:#14171c}text{fill:#e4e6ea}.tick{fill:#9aa3ad}.minor{stroke:#2a2f37}"
    ".axis{stroke:#59616c}.point{fill:#8fb4e8}.fitted{stroke:#ffa94d}"
    ".uncertainty{fill:#ff7a7a;stroke:#ff7a7a}.corner{fill:#ff7a7a}"
    ".round{stroke:#ce93d8}.center{fill:#ce93d8;stroke:#ce93d8}.hub{fill:#ce93d8}"
    ".s1{fill:#4fd1c0;stroke:#4fd1c0}.s2{fill:#6cb2ff;stroke:#6cb2ff}"
    ".sensor{fill:#7ddc85;stroke:#7ddc85}.bar{stroke:#e4e6ea}"};

}  // namespace

double readable_ellipse_scale(const Drawing& drawing, double pixels_per_metre) {
  std::vector<double> axes;
  const auto add = [&](const DrawnCorner& corner) {
    if (finite(corner) && corner.semi_major > 0.0) axes.push_back(corner.semi_major);
  };
  for (const DrawnCorner& corner : drawing.corners) add(corner);
  for (const DrawnCircle& circle : drawing.circles) add(circle.center);
  if (axes.empty()) return 1.0;
  const auto median = axes.begin() + static_cast<std::ptrdiff_t>(axes.size() / 2);
  std::nth_element(axes.begin(), median, axes.end());
  const double wanted = wanted_ellipse / (*median * pixels_per_metre);
  return wanted <= 1.0 ? 1.0 : round_step(wanted);
}

std::string draw_svg(const Drawing& drawing, const DrawingOptions& options) {
  const Projection to(drawing, options.width, options.ellipse_scale);
  const double scale = options.ellipse_scale > 0.0 ? options.ellipse_scale
                                                   : readable_ellipse_scale(drawing, to.scale);
  const double step = grid_step(to.scale);
  const double series_height = drawing.series.empty() ? 0.0 : 24.0;
  Svg svg(options.width, to.bottom() + legend_height + series_height, "scan", style);
  svg.text("title", margin, 26.0, drawing.title);
  svg.text("caption", margin, 46.0, drawing.caption);
  draw_grid(svg, to, step);
  draw_scan(svg, drawing, to);
  draw_circles(svg, drawing, to, scale);
  const std::size_t outside = draw_corners(svg, drawing, to, scale);
  draw_sensor(svg, to);
  draw_legend(svg, drawing, scale, outside, to.bottom() + 60.0);
  draw_scale_bar(svg, to, step, to.bottom() + 60.0);
  return svg.finish();
}

}  // namespace quoin::deploy
