// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/feature_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"
#include "services/topics/protobuf/scene.hpp"

namespace quoin::topics {

namespace {

constexpr SceneColor line_color{0.16, 0.47, 0.84, 1.0};
constexpr SceneColor corner_color{0.86, 0.27, 0.12, 1.0};
constexpr SceneColor circle_color{0.10, 0.60, 0.35, 1.0};
constexpr double cross_size = 0.05;  // [m] from the corner to an end of its cross
constexpr double arc_step = 3.0 / 180.0 * 3.141592653589793;  // [rad]

std::string millimetres(double metres) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f mm", metres * 1e3);
  return text.data();
}

/// Of a variance; what came by the network may be negative.
double deviation(double variance) { return std::sqrt(std::max(variance, 0.0)); }

}  // namespace

bool show_lines(const msg::Lines& message, foxglove::SceneUpdate& out) {
  Scene scene(message.header(), out);
  for (const msg::Line& line : message.lines()) {
    foxglove::SceneEntity& entity = scene.add("line");
    foxglove::LinePrimitive& stroke =
        Scene::add_line(entity, foxglove::LinePrimitive::LINE_STRIP, line_color);
    Scene::add_point(stroke, line.start().x(), line.start().y());
    Scene::add_point(stroke, line.end().x(), line.end().y());
    Scene::describe(entity, "alpha", line.alpha(), "rad");
    Scene::describe(entity, "r", line.r(), "m");
    Scene::describe(entity, "sigma of the direction", deviation(line.covariance_direction()),
                    "rad");
    Scene::describe(entity, "sigma of the offset", deviation(line.covariance_offset()), "m");
    Scene::describe(
        entity, "length",
        std::hypot(line.end().x() - line.start().x(), line.end().y() - line.start().y()), "m");
    Scene::describe(entity, "points", line.points());
    Scene::describe(entity, "chi square", line.chi_square());
    Scene::describe(entity, "segment", line.segment());
  }
  return true;
}

bool show_corners(const msg::Corners& message, foxglove::SceneUpdate& out) {
  Scene scene(message.header(), out);
  for (const msg::Corner& corner : message.corners()) {
    foxglove::SceneEntity& entity = scene.add("corner");
    foxglove::LinePrimitive& cross =
        Scene::add_line(entity, foxglove::LinePrimitive::LINE_LIST, corner_color);
    Scene::add_point(cross, corner.x() - cross_size, corner.y());
    Scene::add_point(cross, corner.x() + cross_size, corner.y());
    Scene::add_point(cross, corner.x(), corner.y() - cross_size);
    Scene::add_point(cross, corner.x(), corner.y() + cross_size);
    Scene::add_ellipse(
        entity, corner.x(), corner.y(),
        {corner.ellipse95_major(), corner.ellipse95_minor(), corner.ellipse95_direction()},
        corner_color);
    const double sigma = deviation(0.5 * (corner.covariance_xx() + corner.covariance_yy()));
    Scene::add_text(entity, corner.x(), corner.y(), millimetres(sigma), corner_color);
    Scene::describe(entity, "x", corner.x(), "m");
    Scene::describe(entity, "y", corner.y(), "m");
    Scene::describe(entity, "sigma of x", deviation(corner.covariance_xx()), "m");
    Scene::describe(entity, "sigma of y", deviation(corner.covariance_yy()), "m");
    Scene::describe(entity, "covariance of x and y", corner.covariance_xy(), "m^2");
    Scene::describe(entity, "angle between the lines", corner.angle(), "rad");
    Scene::describe(entity, "opening", corner.opening(), "rad");
    Scene::describe(entity, "gap", corner.gap(), "m");
    Scene::describe(entity, "extrapolation", corner.extrapolation(), "m");
    Scene::describe(entity, "first line", corner.first_line());
    Scene::describe(entity, "second line", corner.second_line());
  }
  return true;
}

bool show_circles(const msg::Circles& message, foxglove::SceneUpdate& out) {
  Scene scene(message.header(), out);
  for (const msg::Circle& circle : message.circles()) {
    foxglove::SceneEntity& entity = scene.add("circle");
    foxglove::LinePrimitive& arc =
        Scene::add_line(entity, foxglove::LinePrimitive::LINE_STRIP, circle_color);
    // Not by the step alone: what came by the network may hold any angle.
    const double length = std::clamp(circle.arc_end() - circle.arc_start(), 0.0, 6.2832);
    const int steps = std::max(1, static_cast<int>(std::isfinite(length) ? length / arc_step : 1));
    for (int i = 0; i <= steps; ++i) {
      const double angle = circle.arc_start() + length * i / steps;
      Scene::add_point(arc, circle.x() + circle.radius() * std::cos(angle),
                       circle.y() + circle.radius() * std::sin(angle));
    }
    Eigen::Matrix2d covariance;
    covariance << circle.covariance_xx(), circle.covariance_xy(), circle.covariance_xy(),
        circle.covariance_yy();
    Scene::add_ellipse(entity, circle.x(), circle.y(), ellipse(covariance, chi_square_2_95),
                       circle_color);
    Scene::describe(entity, "x", circle.x(), "m");
    Scene::describe(entity, "y", circle.y(), "m");
    Scene::describe(entity, "radius", circle.radius(), "m");
    Scene::describe(entity, "sigma of x", deviation(circle.covariance_xx()), "m");
    Scene::describe(entity, "sigma of y", deviation(circle.covariance_yy()), "m");
    Scene::describe(entity, "sigma of the radius", deviation(circle.covariance_radius()), "m");
    Scene::describe(entity, "points", circle.points());
    Scene::describe(entity, "arc", circle.arc());
  }
  return true;
}

}  // namespace quoin::topics
