// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/cwlf_paper_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "deploy/evaluation/drawing/plot.hpp"
#include "deploy/evaluation/drawing/svg.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/paper_corners.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr double microseconds = 1e6;

struct Step {
  const char* name;
  double CornerTimes::*time;
};

constexpr std::array steps{Step{"lines", &CornerTimes::lines},
                           Step{"covariances of lines", &CornerTimes::line_covariances},
                           Step{"corner", &CornerTimes::position},
                           Step{"covariance of corner", &CornerTimes::covariance},
                           Step{"all", &CornerTimes::all}};

bool timed(const CwlfPaperCorner& corner) { return corner.times.all > 0.0; }

bool same_angle(const CwlfPaperCorner& corner, double angle) {
  return std::abs(corner.angle - angle) < 1e-9;
}

std::string time_text(double seconds) {
  return seconds > 0.0 ? fixed(microseconds * seconds, 3) : "-";
}

std::string sigma_text(const std::optional<CornerEstimate>& corner, int axis) {
  return corner ? fixed(1e3 * std::sqrt(corner->covariance(axis, axis)), 2) : "-";
}

/// Points of both walls for which Fig. 4 or Fig. 5 shows the corner.
bool has_steps(const CwlfPaperCorner& corner) {
  return corner.points == 50 || corner.points == 100;
}

LineSeries times_of(const std::vector<CwlfPaperCorner>& corners, CornerForm form) {
  LineSeries series{std::string(enum_name(form)), {}, {}};
  for (const CwlfPaperCorner& corner : corners) {
    if (!same_angle(corner, figure_4_angle) || corner.form != form || !timed(corner)) continue;
    if (corner.covariance != CovarianceMode::as_published) continue;
    series.x.push_back(static_cast<double>(corner.points));
    series.y.push_back(microseconds * corner.times.all);
  }
  return series;
}

LineSeries ratios_of(const std::vector<CwlfPaperCorner>& corners, CornerForm form,
                     CovarianceMode mode) {
  LineSeries series{std::string(enum_name(form)) + ", " + std::string(enum_name(mode)), {}, {}};
  for (const CwlfPaperCorner& corner : corners) {
    if (!same_angle(corner, figure_4_angle) || corner.form != form || corner.covariance != mode) {
      continue;
    }
    const auto ratio = time_over_cwlf(corners, corner.angle, corner.points, form, mode);
    if (!ratio) continue;
    series.x.push_back(static_cast<double>(corner.points));
    series.y.push_back(*ratio);
  }
  return series;
}

/// One category for each step and number of points, as_published.
IntervalChart step_chart(const std::vector<CwlfPaperCorner>& corners, double angle) {
  IntervalChart chart;
  chart.title = "Time of each step, corner of " + fixed(degrees * angle, 0) + " degrees";
  chart.x = {"time [us]", true};
  for (const auto& [form, name] : EnumNames<CornerForm>::names) {
    IntervalSeries series{std::string(name), {}};
    for (const std::size_t points : {std::size_t{50}, std::size_t{100}}) {
      const CwlfPaperCorner* corner =
          find_corner(corners, angle, points, form, CovarianceMode::as_published);
      for (const Step& step : steps) {
        if (chart.series.empty()) {
          chart.categories.push_back(std::string(step.name) + ", " + std::to_string(points));
        }
        const double time = corner == nullptr ? 0.0 : microseconds * corner->times.*step.time;
        series.values.push_back(time > 0.0 ? std::optional(PlottedInterval{time, time, time})
                                           : std::nullopt);
      }
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

HtmlTable step_table(const std::vector<CwlfPaperCorner>& corners, double angle) {
  HtmlTable table;
  table.groups = {{"", 3}, {"standard deviation [mm]", 2}, {"time [us]", steps.size()}};
  table.head = {"method", "covariance", "points", "x", "y"};
  for (const Step& step : steps) table.head.emplace_back(step.name);
  table.text_columns = 2;
  for (const CwlfPaperCorner& corner : corners) {
    if (!same_angle(corner, angle) || !has_steps(corner)) continue;
    std::vector<std::string> cells{
        std::string(enum_name(corner.form)), std::string(enum_name(corner.covariance)),
        std::to_string(corner.points), sigma_text(corner.corner, 0), sigma_text(corner.corner, 1)};
    for (const Step& step : steps) cells.push_back(time_text(corner.times.*step.time));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace

const CwlfPaperCorner* find_corner(const std::vector<CwlfPaperCorner>& corners, double angle,
                                   std::size_t points, CornerForm form, CovarianceMode mode) {
  const auto found = std::find_if(corners.begin(), corners.end(), [&](const auto& corner) {
    return same_angle(corner, angle) && corner.points == points && corner.form == form &&
           corner.covariance == mode;
  });
  return found == corners.end() ? nullptr : &*found;
}

std::optional<double> time_over_cwlf(const std::vector<CwlfPaperCorner>& corners, double angle,
                                     std::size_t points, CornerForm form, CovarianceMode mode) {
  const CwlfPaperCorner* corner = find_corner(corners, angle, points, form, mode);
  const CwlfPaperCorner* cwlf = find_corner(corners, angle, points, CornerForm::cwlf, mode);
  if (corner == nullptr || cwlf == nullptr || !timed(*corner) || !timed(*cwlf)) return std::nullopt;
  return corner->times.all / cwlf->times.all;
}

void write_environment(HtmlPage& page, const PublishedTable& published,
                       const CwlfPaperEnvironment& result) {
  page.heading(3, result.world + " (" + published.place + ")");
  page.paragraph("One scan of " + std::to_string(result.rays) +
                 " rays: " + std::to_string(result.walls) + " straight sections and " +
                 std::to_string(result.truth.size()) +
                 " corners in sight. Standard deviations [mm] of the corners, clockwise, beside "
                 "the paper's " +
                 published.place +
                 ". The corners are not the same corners: what can be compared is the means in "
                 "the last row.");
  const CornersOf corners_of = corners_in(result.methods);
  page.table(sigma_table(published, corners_of, {"mean", mean_of}));
  DrawingOptions options;
  options.ellipse_scale = ellipse_expansion;
  const CovarianceMode mode = CovarianceMode::as_published;
  page.figure(draw_svg(ellipse_drawing(result.world, result.points, result.lines,
                                       {"arras_siegwart", "cwlf"}, mode, corners_of),
                       options),
              "The environment (Fig. 2) with the one-sigma ellipses, as_published, enlarged 10 "
              "times.");
}

void write_times(HtmlPage& page, const std::vector<CwlfPaperCorner>& corners) {
  if (std::none_of(corners.begin(), corners.end(), timed)) return;
  page.heading(3, "Time against the number of measurements (Fig. 3)");
  LineChart times;
  times.title = "Time of a corner of 130 degrees";
  times.x = {"points of both walls", true};
  times.y = {"time [us]", true};
  LineChart ratios;
  ratios.title = "Time of a corner by Arras-Siegwart over that by CWLF";
  ratios.x = times.x;
  ratios.y = {"ratio", true};
  for (const auto& [form, name] : EnumNames<CornerForm>::names) {
    times.series.push_back(times_of(corners, form));
    if (form == CornerForm::cwlf) continue;
    for (const CovarianceMode mode : paper_modes) {
      ratios.series.push_back(ratios_of(corners, form, mode));
    }
  }
  page.figure(plot_svg(times),
              "Both lines, their covariances, the corner and its covariance, as_published.");
  page.figure(
      plot_svg(ratios),
      "The paper compares with the double sums of the literal form. The as_published covariance "
      "of cwlf follows from sums that the line needs anyway; the propagated one passes over "
      "the points again, as that of arras_siegwart does in both modes.");
}

void write_steps(HtmlPage& page, const std::vector<CwlfPaperCorner>& corners) {
  page.heading(3, "Four steps to a corner (Figs. 4 and 5)");
  page.paragraph(
      "Two walls of 1.5 m that meet 3 m away, with 25 or 50 points each. Every step is measured "
      "alone, all of them in one go. The covariance of arras_siegwart_literal is computed in "
      "linear "
      "time and includes the moments that it needs.");
  const bool with_times = std::any_of(corners.begin(), corners.end(), timed);
  for (const double angle : {figure_4_angle, figure_5_angle}) {
    if (with_times) {
      page.figure(plot_svg(step_chart(corners, angle)),
                  "Steps at 50 and at 100 points, as_published; left is fast.");
    }
    page.table(step_table(corners, angle));
  }
}

}  // namespace quoin::deploy
