// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>

#include "deploy/evaluation/drawing/plot.hpp"
#include "deploy/evaluation/drawing/plot_frame.hpp"

namespace quoin::deploy {

namespace {

constexpr double widest_box = 46.0;

void draw_box(Svg& svg, const PlottedBox& box, const Scale& y, std::size_t series, double middle,
              double width) {
  const double left = middle - 0.5 * width;
  const double low = y.pixel(box.low), high = y.pixel(box.high);
  const double bottom = y.pixel(box.first_quartile), top = y.pixel(box.third_quartile);
  const std::string whisker = series_style("whisker", series);
  svg.line(whisker, middle, low, middle, bottom);
  svg.line(whisker, middle, top, middle, high);
  svg.line(whisker, middle - 0.25 * width, low, middle + 0.25 * width, low);
  svg.line(whisker, middle - 0.25 * width, high, middle + 0.25 * width, high);
  svg.rectangle(series_style("box", series), left, top, width, std::max(0.0, bottom - top));
  svg.line(series_style("median", series), left, y.pixel(box.median), left + width,
           y.pixel(box.median));
  for (const double outlier : box.outliers) {
    if (y.shows(outlier))
      svg.circle(series_style("outlier", series), middle, y.pixel(outlier), 2.6);
  }
}

void draw_point(Svg& svg, const PlottedInterval& value, const Scale& y, std::size_t series,
                double x) {
  const std::string whisker = series_style("whisker", series);
  const double low = y.pixel(value.low), high = y.pixel(value.high);
  svg.line(whisker, x, low, x, high);
  svg.line(whisker, x - 5.0, low, x + 5.0, low);
  svg.line(whisker, x - 5.0, high, x + 5.0, high);
  draw_marker(svg, series, x, y.pixel(value.value));
}

std::vector<double> values_of(const BoxPlot& plot) {
  std::vector<double> all;
  for (const BoxSeries& series : plot.series) {
    for (const auto& box : series.boxes) {
      if (!box) continue;
      all.insert(all.end(), {box->low, box->high, box->median});
      all.insert(all.end(), box->outliers.begin(), box->outliers.end());
    }
  }
  for (const IntervalSeries& series : plot.points) {
    for (const auto& point : series.values) {
      if (point) all.insert(all.end(), {point->low, point->value, point->high});
    }
  }
  return all;
}

}  // namespace

std::string plot_svg(const BoxPlot& plot) {
  std::vector<LegendEntry> legend;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    legend.push_back({plot.series[k].name, LegendMark::box, k});
  }
  for (std::size_t k = 0; k < plot.points.size(); ++k) {
    legend.push_back({plot.points[k].name, LegendMark::point, plot.series.size() + k});
  }
  PlotFrame frame(plot.title, legend, 320.0, 84.0);
  const Scale y(plot.y, values_of(plot), frame.bottom, frame.top);
  frame.vertical_axis(plot.y, y);
  frame.border();
  const std::size_t slots = plot.series.size() + plot.points.size();
  const double column =
      (frame.right - frame.left) / std::max(1.0, static_cast<double>(plot.categories.size()));
  const double slot = 0.8 * column / std::max(1.0, static_cast<double>(slots));
  for (std::size_t i = 0; i < plot.categories.size(); ++i) {
    const double middle = frame.left + column * (static_cast<double>(i) + 0.5);
    const auto at = [&](std::size_t k) {
      return middle + (static_cast<double>(k) - 0.5 * (static_cast<double>(slots) - 1.0)) * slot;
    };
    frame.svg().text("middle", middle, frame.bottom + 22.0, plot.categories[i]);
    for (std::size_t k = 0; k < plot.series.size(); ++k) {
      const auto& boxes = plot.series[k].boxes;
      if (i >= boxes.size() || !boxes[i]) continue;
      draw_box(frame.svg(), *boxes[i], y, k, at(k), std::min(widest_box, 0.7 * slot));
    }
    for (std::size_t k = 0; k < plot.points.size(); ++k) {
      const auto& values = plot.points[k].values;
      if (i >= values.size() || !values[i] || !y.shows(values[i]->value)) continue;
      draw_point(frame.svg(), *values[i], y, plot.series.size() + k, at(plot.series.size() + k));
    }
  }
  return frame.svg().finish();
}

}  // namespace quoin::deploy
