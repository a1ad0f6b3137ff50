// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "deploy/evaluation/drawing/plot.hpp"
#include "deploy/evaluation/drawing/plot_frame.hpp"

namespace quoin::deploy {

std::string plot_svg(const LineChart& chart) {
  std::vector<LegendEntry> legend;
  std::vector<double> all_x, all_y;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const LineSeries& series = chart.series[k];
    legend.push_back({series.name, LegendMark::line, k});
    all_x.insert(all_x.end(), series.x.begin(), series.x.end());
    all_y.insert(all_y.end(), series.y.begin(), series.y.end());
  }
  PlotFrame frame(chart.title, legend, 320.0, 84.0);
  const Scale x(chart.x, all_x, frame.left, frame.right);
  const Scale y(chart.y, all_y, frame.bottom, frame.top);
  frame.horizontal_axis(chart.x, x);
  frame.vertical_axis(chart.y, y);
  frame.border();
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const LineSeries& series = chart.series[k];
    std::string curve;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      // A gap where a point cannot be shown would read as a trend.
      if (!x.shows(series.x[i]) || !y.shows(series.y[i])) continue;
      curve += (curve.empty() ? "M" : "L") + number(x.pixel(series.x[i]), 2) + " " +
               number(y.pixel(series.y[i]), 2);
    }
    if (curve.empty()) continue;
    frame.svg().path(series_style("curve", k) + " d" + std::to_string(k % 4), curve);
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (!x.shows(series.x[i]) || !y.shows(series.y[i])) continue;
      draw_marker(frame.svg(), k, x.pixel(series.x[i]), y.pixel(series.y[i]));
    }
  }
  return frame.svg().finish();
}

}  // namespace quoin::deploy
