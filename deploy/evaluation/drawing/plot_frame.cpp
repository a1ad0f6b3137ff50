// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/plot_frame.hpp"

#include <array>

#include "deploy/evaluation/drawing/plot.hpp"

namespace quoin::deploy {

namespace {

constexpr double right_margin = 28.0;
constexpr double title_height = 40.0;
constexpr double legend_row = 22.0;
constexpr double axis_height = 56.0;
constexpr double mark_width = 34.0;
constexpr std::size_t colours = 8;

// Colours after Okabe and Ito, which the colour-blind can distinguish; brighter on dark.
constexpr StyleSheet plot_style{
    "text{font-family:system-ui,sans-serif;font-size:13px;fill:#24292f}"
    ".title{font-size:15px;font-weight:600}.tick{font-size:12px;fill:#57606a}"
    ".middle{text-anchor:middle}.end{text-anchor:end}"
    ".grid{stroke:#e3e6ea}.fine{stroke:#f1f3f5}.border{fill:none;stroke:#8c959f}"
    ".band{fill:#f6f8fa}"
    ".reference{stroke:#24292f;stroke-width:1.4;stroke-dasharray:6 4}"
    ".curve,.whisker,.median{fill:none;stroke:currentColor;stroke-width:1.8}"
    ".median{stroke-width:3}.marker{fill:currentColor;stroke:currentColor;stroke-width:1.6}"
    ".box{fill:currentColor;fill-opacity:.22;stroke:currentColor;stroke-width:1.6}"
    ".outlier{fill:none;stroke:currentColor;stroke-width:1.2}"
    ".d1{stroke-dasharray:7 4}.d2{stroke-dasharray:2 3}.d3{stroke-dasharray:9 3 2 3}"
    ".s0{color:#0072b2}.s1{color:#d55e00}.s2{color:#009e73}.s3{color:#b0568c}"
    ".s4{color:#b07800}.s5{color:#2a9fd6}.s6{color:#6e5fb0}.s7{color:#57606a}",
    ".background{fill:#14171c}text{fill:#e4e6ea}.tick{fill:#a9b1bb}.grid{stroke:#2c323a}"
    ".fine{stroke:#20252c}.border{stroke:#59616c}.band{fill:#1a1e24}.reference{stroke:#e4e6ea}"
    ".s0{color:#58b4f0}.s1{color:#ff8f4a}.s2{color:#36cfa1}.s3{color:#e79ac6}"
    ".s4{color:#f0bb4a}.s5{color:#8ad4f8}.s6{color:#b3a6f0}.s7{color:#b4bcc6}"};

double entry_width(const LegendEntry& entry) { return mark_width + text_width(entry.name) + 20.0; }

/// Rows of the legend when it breaks at the right margin.
std::size_t legend_rows(const std::vector<LegendEntry>& legend, double left) {
  if (legend.empty()) return 0;
  std::size_t rows = 1;
  double x = left;
  for (const LegendEntry& entry : legend) {
    if (x > left && x + entry_width(entry) > plot_width) {
      ++rows;
      x = left;
    }
    x += entry_width(entry);
  }
  return rows;
}

double legend_left() { return 20.0; }

double top_of(const std::vector<LegendEntry>& legend) {
  return title_height + legend_row * static_cast<double>(legend_rows(legend, legend_left())) + 6.0;
}

}  // namespace

double text_width(const std::string& text) { return 7.2 * static_cast<double>(text.size()); }

std::string series_style(const char* style_name, std::size_t series) {
  return std::string(style_name) + " s" + std::to_string(series % colours);
}

void draw_marker(Svg& svg, std::size_t series, double x, double y) {
  const auto at = [](double value) { return number(value, 2); };
  const auto to = [&](const char* command, double dx, double dy) {
    return std::string(command) + at(x + dx) + " " + at(y + dy);
  };
  std::string path;
  switch (series % 5) {
    case 0:
      svg.circle(series_style("marker", series), x, y, 4.0);
      return;
    case 1:
      path = to("M", -3.8, -3.8) + to("L", 3.8, -3.8) + to("L", 3.8, 3.8) + to("L", -3.8, 3.8);
      break;
    case 2:
      path = to("M", 0.0, -5.0) + to("L", 4.8, 3.8) + to("L", -4.8, 3.8);
      break;
    case 3:
      path = to("M", 0.0, -5.4) + to("L", 5.4, 0.0) + to("L", 0.0, 5.4) + to("L", -5.4, 0.0);
      break;
    default:
      path = to("M", 0.0, 5.0) + to("L", 4.8, -3.8) + to("L", -4.8, -3.8);
  }
  svg.path(series_style("marker", series), path + "Z");
}

PlotFrame::PlotFrame(const std::string& title, const std::vector<LegendEntry>& legend,
                     double height, double labels)
    : left(labels),
      right(plot_width - right_margin),
      top(top_of(legend)),
      bottom(top_of(legend) + height),
      svg_(plot_width, top_of(legend) + height + axis_height, "plot", plot_style) {
  svg_.text("title", legend_left(), 26.0, title);
  draw_legend(legend);
}

void PlotFrame::draw_legend(const std::vector<LegendEntry>& legend) {
  double x = legend_left();
  double y = title_height + 0.5 * legend_row;
  svg_.open("g", {{"class", "legend"}});
  for (const LegendEntry& entry : legend) {
    if (x > legend_left() && x + entry_width(entry) > plot_width) {
      x = legend_left();
      y += legend_row;
    }
    switch (entry.mark) {
      case LegendMark::line:
        svg_.line(series_style("curve", entry.series) + " d" + std::to_string(entry.series % 4), x,
                  y, x + 28.0, y);
        draw_marker(svg_, entry.series, x + 14.0, y);
        break;
      case LegendMark::point:
        svg_.line(series_style("whisker", entry.series), x + 2.0, y, x + 26.0, y);
        draw_marker(svg_, entry.series, x + 14.0, y);
        break;
      case LegendMark::box:
        svg_.rectangle(series_style("box", entry.series), x + 4.0, y - 6.0, 20.0, 12.0);
        svg_.line(series_style("median", entry.series), x + 4.0, y, x + 24.0, y);
        break;
      case LegendMark::reference:
        svg_.line("reference", x, y, x + 28.0, y);
        break;
    }
    svg_.text("entry", x + mark_width, y + 4.5, entry.name);
    x += entry_width(entry);
  }
  svg_.close("g");
}

void PlotFrame::horizontal_axis(const PlotAxis& axis, const Scale& scale) {
  for (const Tick& tick : scale.ticks()) {
    const double x = scale.pixel(tick.value);
    svg_.line(tick.label.empty() ? "fine" : "grid", x, top, x, bottom);
    if (!tick.label.empty()) svg_.text("tick middle", x, bottom + 18.0, tick.label);
  }
  svg_.text("middle", 0.5 * (left + right), bottom + 42.0, axis.title);
}

void PlotFrame::vertical_axis(const PlotAxis& axis, const Scale& scale) {
  for (const Tick& tick : scale.ticks()) {
    const double y = scale.pixel(tick.value);
    svg_.line(tick.label.empty() ? "fine" : "grid", left, y, right, y);
    if (!tick.label.empty()) svg_.text("tick end", left - 8.0, y + 4.0, tick.label);
  }
  svg_.vertical_text("middle", 20.0, 0.5 * (top + bottom), axis.title);
}

void PlotFrame::border() { svg_.rectangle("border", left, top, right - left, bottom - top); }

}  // namespace quoin::deploy
