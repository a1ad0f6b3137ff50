// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "deploy/evaluation/drawing/plot.hpp"
#include "deploy/evaluation/drawing/plot_frame.hpp"

namespace quoin::deploy {

namespace {

constexpr double series_height = 17.0;
constexpr double category_gap = 12.0;

}  // namespace

std::string plot_svg(const IntervalChart& chart) {
  std::vector<LegendEntry> legend;
  std::vector<double> all;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    legend.push_back({chart.series[k].name, LegendMark::point, k});
    for (const auto& value : chart.series[k].values) {
      if (value) all.insert(all.end(), {value->value, value->low, value->high});
    }
  }
  if (chart.reference) {
    legend.push_back({chart.reference_name, LegendMark::reference, 0});
    all.push_back(*chart.reference);
  }
  double labels = 60.0;
  for (const std::string& category : chart.categories) {
    labels = std::max(labels, text_width(category) + 32.0);
  }
  const auto series_count = static_cast<double>(chart.series.size());
  const double row = series_count * series_height + category_gap;
  PlotFrame frame(chart.title, legend,
                  row * std::max(1.0, static_cast<double>(chart.categories.size())), labels);
  Svg& svg = frame.svg();
  for (std::size_t i = 0; i < chart.categories.size(); ++i) {
    const double top = frame.top + row * static_cast<double>(i);
    if (i % 2 == 1) svg.rectangle("band", frame.left, top, frame.right - frame.left, row);
  }
  const Scale x(chart.x, all, frame.left, frame.right);
  frame.horizontal_axis(chart.x, x);
  if (chart.reference) {
    const double at = x.pixel(*chart.reference);
    svg.line("reference", at, frame.top, at, frame.bottom);
  }
  frame.border();
  for (std::size_t i = 0; i < chart.categories.size(); ++i) {
    const double middle = frame.top + row * (static_cast<double>(i) + 0.5);
    svg.text("end", frame.left - 10.0, middle + 4.5, chart.categories[i]);
    for (std::size_t k = 0; k < chart.series.size(); ++k) {
      if (i >= chart.series[k].values.size() || !chart.series[k].values[i]) continue;
      const PlottedInterval& value = *chart.series[k].values[i];
      if (!x.shows(value.value)) continue;
      const double y =
          middle + (static_cast<double>(k) - 0.5 * (series_count - 1.0)) * series_height;
      const double low = x.pixel(value.low);
      const double high = x.pixel(value.high);
      svg.line(series_style("whisker", k), low, y, high, y);
      svg.line(series_style("whisker", k), low, y - 3.5, low, y + 3.5);
      svg.line(series_style("whisker", k), high, y - 3.5, high, y + 3.5);
      draw_marker(svg, k, x.pixel(value.value), y);
    }
  }
  return svg.finish();
}

}  // namespace quoin::deploy
