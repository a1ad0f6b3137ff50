// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/message_drawing.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin::deploy {

void add_points(std::span<const float> bearings, std::span<const float> ranges, Drawing& drawing) {
  const std::size_t count = std::min(bearings.size(), ranges.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double bearing = bearings[i];
    const double range = ranges[i];
    if (!std::isfinite(range)) continue;
    drawing.points.push_back({range * std::cos(bearing), range * std::sin(bearing)});
  }
}

void add_lines(const msg::Lines& message, Drawing& drawing) {
  for (const msg::Line& line : message.lines()) {
    drawing.lines.push_back(
        {{line.start().x(), line.start().y()}, {line.end().x(), line.end().y()}});
  }
}

void add_corners(const msg::Corners& message, Drawing& drawing) {
  for (const msg::Corner& corner : message.corners()) {
    drawing.corners.push_back({{corner.x(), corner.y()},
                               corner.ellipse95_major(),
                               corner.ellipse95_minor(),
                               corner.ellipse95_direction()});
  }
}

void add_circles(const msg::Circles& message, Drawing& drawing) {
  for (const msg::Circle& circle : message.circles()) {
    Eigen::Matrix2d covariance;
    covariance << circle.covariance_xx(), circle.covariance_xy(), circle.covariance_xy(),
        circle.covariance_yy();
    const Ellipse shape = ellipse(covariance, chi_square_2_95);
    drawing.circles.push_back(
        {{{circle.x(), circle.y()}, shape.semi_major, shape.semi_minor, shape.direction},
         circle.radius()});
  }
}

std::string stages_text(const msg::Header& header) {
  std::string text;
  for (const msg::StageTrace& stage : header.trace()) {
    text += (text.empty() ? "" : ", ") + stage.service();
    if (!stage.method().empty()) text += " (" + stage.method() + ")";
  }
  return text;
}

}  // namespace quoin::deploy
