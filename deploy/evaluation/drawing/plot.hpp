// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deploy/evaluation/drawing/axis.hpp"

namespace quoin::deploy {

/// Every plot is the text of an SVG file of `plot_width` pixels. Series are distinguished by colour
/// and by marker, dash or pattern; what is not finite is left out.
inline constexpr double plot_width = 820.0;

/// Points joined by lines.
struct LineSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

struct LineChart {
  std::string title;
  PlotAxis x;
  PlotAxis y;
  std::vector<LineSeries> series;
};

[[nodiscard]] std::string plot_svg(const LineChart& chart);

/// A figure with its confidence interval or spread.
struct PlottedInterval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// One figure for each category; nothing where there is none.
struct IntervalSeries {
  std::string name;
  std::vector<std::optional<PlottedInterval>> values;
};

/// Categories from top to bottom, a point with whiskers for each series.
struct IntervalChart {
  std::string title;
  PlotAxis x;
  std::vector<std::string> categories;
  std::vector<IntervalSeries> series;
  std::optional<double> reference = std::nullopt;  ///< value of a line across all categories
  std::string reference_name;
};

[[nodiscard]] std::string plot_svg(const IntervalChart& chart);

struct PlottedBox {
  double low = 0.0;  ///< end of the lower whisker
  double first_quartile = 0.0;
  double median = 0.0;
  double third_quartile = 0.0;
  double high = 0.0;  ///< end of the upper whisker
  std::vector<double> outliers;
};

struct BoxSeries {
  std::string name;
  std::vector<std::optional<PlottedBox>> boxes;  ///< one for each category
};

/// Categories from left to right, a box for each series, and points with whiskers beside them.
struct BoxPlot {
  std::string title;
  PlotAxis y;
  std::vector<std::string> categories;
  std::vector<BoxSeries> series;
  std::vector<IntervalSeries> points;
};

[[nodiscard]] std::string plot_svg(const BoxPlot& plot);

}  // namespace quoin::deploy
