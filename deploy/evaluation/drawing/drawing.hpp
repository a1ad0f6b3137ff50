// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace quoin::deploy {

/// A point in the sensor's frame.
struct DrawnPoint {
  double x = 0.0;  ///< [m] forward
  double y = 0.0;  ///< [m] left
};

struct DrawnLine {
  DrawnPoint start;
  DrawnPoint end;
};

struct DrawnCorner {
  DrawnPoint position;
  double semi_major = 0.0;  ///< [m] of the ellipse
  double semi_minor = 0.0;  ///< [m]
  double direction = 0.0;   ///< [rad] of the major axis
  std::size_t series = 0;   ///< index in Drawing::series
};

struct DrawnCircle {
  DrawnCorner center;   ///< with its ellipse
  double radius = 0.0;  ///< [m]
};

/// One scan with what was found in it.
struct Drawing {
  std::string title;
  std::string caption;
  std::vector<DrawnPoint> points;
  std::vector<DrawnLine> lines;
  std::vector<DrawnCorner> corners;
  std::vector<DrawnCircle> circles;
  std::string ellipses = "95 % ellipses";  ///< what the ellipses are
  /// Names of up to three sets of corners that are to be distinguished; none when there is one set.
  std::vector<std::string> series;
};

struct DrawingOptions {
  double width = 1000.0;       ///< of the picture, in SVG units (pixels)
  double ellipse_scale = 0.0;  ///< ellipses are drawn enlarged this many times; 0 chooses
};

/// How many times ellipses are enlarged to be seen when a metre is `pixels_per_metre` long: 1, 2 or
/// 5 times a power of ten.
[[nodiscard]] double readable_ellipse_scale(const Drawing& drawing, double pixels_per_metre);

/// The picture as the text of an SVG file: x to the right, y up, with grid, axes, scale bar, sensor
/// and legend. What is not finite is left out.
[[nodiscard]] std::string draw_svg(const Drawing& drawing, const DrawingOptions& options = {});

}  // namespace quoin::deploy
