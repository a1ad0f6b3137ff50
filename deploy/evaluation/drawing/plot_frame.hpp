// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "deploy/evaluation/drawing/axis.hpp"
#include "deploy/evaluation/drawing/svg.hpp"

namespace quoin::deploy {

/// How an entry of the legend is drawn.
enum class LegendMark { line, point, box, reference };

struct LegendEntry {
  std::string name;
  LegendMark mark = LegendMark::line;
  std::size_t series = 0;
};

/// What all plots have in common: picture, title, legend, and where the data goes.
class PlotFrame {
 public:
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;  // [pixel] of the area of the data

  /// `height` is that of the area of the data, `labels` the width to its left.
  PlotFrame(const std::string& title, const std::vector<LegendEntry>& legend, double height,
            double labels);

  Svg& svg() { return svg_; }
  void horizontal_axis(const PlotAxis& axis, const Scale& scale);
  void vertical_axis(const PlotAxis& axis, const Scale& scale);
  /// The border of the area of the data.
  void border();

 private:
  void draw_legend(const std::vector<LegendEntry>& legend);

  Svg svg_;
};

/// Pixels that a text of the plots' normal size takes, about.
[[nodiscard]] double text_width(const std::string& text);

/// A class of the style sheet with the colour of a series.
[[nodiscard]] std::string series_style(const char* style, std::size_t series);

/// The marker of a series.
void draw_marker(Svg& svg, std::size_t series, double x, double y);

}  // namespace quoin::deploy
