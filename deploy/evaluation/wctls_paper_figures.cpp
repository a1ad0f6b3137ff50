// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/wctls_paper_figures.hpp"

#include <cmath>

#include "core/statistics/order_statistics.hpp"
#include "deploy/evaluation/drawing/plot.hpp"
#include "deploy/evaluation/paper_corners.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr double square_millimetres = 1e6;  // per m^2

BoxPlot areas(const WctlsPaperEnvironment& result) {
  BoxPlot plot{"Median ellipse area per scan, " + result.world,
               {"median one-sigma ellipse area [mm^2]", true},
               {wctls_paper_fitters.begin(), wctls_paper_fitters.end()},
               {},
               {}};
  for (const CovarianceMode mode : paper_modes) {
    BoxSeries series{"here, " + std::string(enum_name(mode)), {}};
    for (const char* fitter : wctls_paper_fitters) {
      std::vector<double> values = method_of(result.methods, fitter, mode).median_areas;
      for (double& value : values) value *= square_millimetres;
      const BoxSummary box = box_summary(values);
      if (values.empty()) {
        series.boxes.emplace_back();
      } else {
        series.boxes.emplace_back(PlottedBox{box.low, box.first_quartile, box.median,
                                             box.third_quartile, box.high, box.outliers});
      }
    }
    plot.series.push_back(std::move(series));
  }
  IntervalSeries published{"the paper, median +- spread", {}};
  for (const PublishedArea& area : published_wctls_areas()) {
    if (area.environment != result.world) continue;
    published.values.emplace_back(
        PlottedInterval{area.area, area.area - area.spread, area.area + area.spread});
  }
  plot.points.push_back(std::move(published));
  return plot;
}

void write_areas(HtmlPage& page, const WctlsPaperEnvironment& result) {
  HtmlTable table{
      {},
      {"median ellipse area [mm^2]", "the paper", "here, as_published", "here, propagated"},
      {},
      1,
      true};
  const auto cell = [&](const std::string& fitter, CovarianceMode mode) {
    const std::vector<double>& values = method_of(result.methods, fitter, mode).median_areas;
    return text(area_of(result, fitter, mode), 1) + " +- " +
           fixed(square_millimetres * standard_deviation(values), 1);
  };
  for (const PublishedArea& area : published_wctls_areas()) {
    if (area.environment != result.world) continue;
    table.rows.push_back({area.method, fixed(area.area, 1) + " +- " + fixed(area.spread, 1),
                          cell(area.method, CovarianceMode::as_published),
                          cell(area.method, CovarianceMode::propagated)});
  }
  table.rows.push_back({"utls / wctls", fixed(published_area_ratio(result.world), 2),
                        text(area_ratio(result, CovarianceMode::as_published), 2),
                        text(area_ratio(result, CovarianceMode::propagated), 2)});
  page.table(table);
}

}  // namespace

std::optional<double> area_of(const WctlsPaperEnvironment& result, const std::string& fitter,
                              CovarianceMode mode) {
  const auto area = median_of(method_of(result.methods, fitter, mode).median_areas);
  return area ? std::optional(*area * square_millimetres) : std::nullopt;
}

std::optional<double> area_ratio(const WctlsPaperEnvironment& result, CovarianceMode mode) {
  const auto utls = area_of(result, "utls", mode);
  const auto wctls = area_of(result, "wctls", mode);
  return utls && wctls ? std::optional(*utls / *wctls) : std::nullopt;
}

double published_area_ratio(const std::string& world) {
  double utls = 0.0;
  double wctls = 1.0;
  for (const PublishedArea& area : published_wctls_areas()) {
    if (area.environment != world) continue;
    if (area.method == "utls") utls = area.area;
    if (area.method == "wctls") wctls = area.area;
  }
  return utls / wctls;
}

void write_environment(HtmlPage& page, const PublishedTable& published,
                       const WctlsPaperEnvironment& result) {
  const CornersOf corners_of = corners_in(result.methods);
  page.heading(3, result.world + " (" + published.place + ")");
  page.paragraph("Standard deviations [mm] of the corners of one scan (number " +
                 std::to_string(result.representative) + " of " + std::to_string(result.scans) +
                 ", the first with most corners), clockwise, beside the paper's " +
                 published.place +
                 ". The corners are not the same corners: what can be compared is the medians "
                 "in the last row. - marks a corner that was not found.");
  page.table(sigma_table(published, corners_of, {"median", median_of}));
  DrawingOptions options;
  options.ellipse_scale = ellipse_expansion;
  for (const CovarianceMode mode : paper_modes) {
    // The largest first, so that none hides another; in the paper's colours wctls is red.
    page.figure(draw_svg(ellipse_drawing(result.world, result.points, result.lines,
                                         {"wctls", "wtls", "utls"}, mode, corners_of),
                         options),
                "One-sigma ellipses of the three fitters, " + std::string(enum_name(mode)) +
                    ", enlarged 10 times, as in the paper's Fig. 3.");
  }
  page.figure(plot_svg(areas(result)),
              "Median area of the one-sigma ellipses of a scan, over " +
                  std::to_string(result.scans) +
                  " scans (Fig. 4): box between the quartiles, whiskers to 1.5 times their "
                  "distance, circles beyond. The paper's figure is its median with the spread "
                  "it prints.");
  write_areas(page, result);
}

}  // namespace quoin::deploy
