// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/order_statistics.hpp"
#include "core/evaluation/published_figures.hpp"
#include "core/evaluation/wctls_paper.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/pictures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/report/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t scans = 100;          // as the paper
constexpr double expansion = 10.0;          // of the ellipses in the paper's Fig. 3
constexpr double square_millimetres = 1e6;  // per m^2
constexpr std::array<const char*, 3> fitters{"utls", "wtls", "wctls"};
constexpr std::array modes{CovarianceMode::as_published, CovarianceMode::propagated};

/// Standard deviations [m] of the corners that were found; NaN for the others.
struct Sigmas {
  std::vector<double> x, y;
};

Sigmas sigmas_of(const WctlsPaperMethod& method) {
  Sigmas sigmas;
  for (const auto& corner : method.corners) {
    sigmas.x.push_back(corner ? std::sqrt(corner->covariance(0, 0)) : std::nan(""));
    sigmas.y.push_back(corner ? std::sqrt(corner->covariance(1, 1)) : std::nan(""));
  }
  return sigmas;
}

/// Of those that are numbers; nothing without any.
std::optional<double> median_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::nullopt;
  return median(std::move(values));
}

std::string text(const std::optional<double>& value, int digits) {
  return value && std::isfinite(*value) ? fixed(*value, digits) : "-";
}

nlohmann::ordered_json json_of(const std::vector<double>& values) {
  auto array = nlohmann::ordered_json::array();
  for (const double value : values) {
    array.push_back(std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value));
  }
  return array;
}

class WctlsPaperSection : public Section {
 public:
  explicit WctlsPaperSection(const EvaluationSetup& setup)
      : seed_(setup.options.seed), tables_(published_wctls_tables()) {
    results_.resize(tables_.size());
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      jobs.push_back({tables_[k].environment, [this, k](const auto& stop) { repeat(k, stop); }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto environments = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      environments.push_back(environment_json(results_[k]));
      add_comparisons(report, k);
    }
    report["wctls_paper"] = {{"range_stddev", data_sheet_model().range_stddev},
                             {"bearing_stddev", data_sheet_model().bearing_stddev},
                             {"noise_range_stddev", noise_.range_stddev},
                             {"noise_bearing_stddev", noise_.bearing_stddev},
                             {"environments", std::move(environments)}};
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "What section 4 of the WCTLS paper shows, repeated on two simulated worlds of the sizes "
        "and the numbers of points, segments and corners that it gives. The scans have noise of " +
        noise_text(noise_) +
        "; the covariances are computed, as in the paper, from the data sheet's figures taken for "
        "standard deviations (" +
        noise_text(data_sheet_model()) +
        "). as_published reads the paper's equation 5 literally: one common error for a whole "
        "segment. propagated sums independent contributions of all points.");
    for (std::size_t k = 0; k < tables_.size(); ++k) write_environment(page, k);
  }

  SummaryTable summary() const override {
    SummaryTable rows{
        {"median ellipse area", "fitter", "published [mm^2]", "as_published", "propagated"}};
    for (const PublishedArea& area : published_wctls_areas()) {
      const WctlsPaperEnvironment& result = result_of(area.environment);
      rows.push_back({area.environment, area.method, fixed(area.area, 1),
                      text(area_of(result, area.method, CovarianceMode::as_published), 1),
                      text(area_of(result, area.method, CovarianceMode::propagated), 1)});
    }
    for (const WctlsPaperEnvironment& result : results_) {
      rows.push_back({result.world, "utls/wctls", fixed(published_ratio(result.world), 2),
                      text(ratio(result, CovarianceMode::as_published), 2),
                      text(ratio(result, CovarianceMode::propagated), 2)});
    }
    return rows;
  }

 private:
  void repeat(std::size_t k, const std::stop_token& stop) {
    const World world = built_in_world(tables_[k].environment).value();
    std::vector<NamedFitter> named;
    for (const CovarianceMode mode : modes) {
      for (const char* fitter : fitters) {
        named.push_back(
            {fitter, mode, stoppable(make_fitter(fitter, std::string(enum_name(mode))), stop)});
      }
    }
    results_[k] = repeat_wctls_paper(
        world, make_segmenter("iepf"), CornerFinders::make<CornerFinder>("adjacent", {}), named,
        noise_, scans, derived_seed(seed_, "wctls_paper/" + world.name));
  }

  [[nodiscard]] const WctlsPaperEnvironment& result_of(const std::string& world) const {
    return *std::find_if(results_.begin(), results_.end(),
                         [&](const auto& result) { return result.world == world; });
  }

  static const WctlsPaperMethod& method_of(const WctlsPaperEnvironment& result,
                                           const std::string& fitter, CovarianceMode mode) {
    return *std::find_if(result.methods.begin(), result.methods.end(), [&](const auto& method) {
      return method.fitter == fitter && method.covariance == mode;
    });
  }

  /// [mm^2]
  static std::optional<double> area_of(const WctlsPaperEnvironment& result,
                                       const std::string& fitter, CovarianceMode mode) {
    const auto area = median_of(method_of(result, fitter, mode).median_areas);
    return area ? std::optional(*area * square_millimetres) : std::nullopt;
  }

  static std::optional<double> ratio(const WctlsPaperEnvironment& result, CovarianceMode mode) {
    const auto utls = area_of(result, "utls", mode);
    const auto wctls = area_of(result, "wctls", mode);
    return utls && wctls ? std::optional(*utls / *wctls) : std::nullopt;
  }

  static double published_ratio(const std::string& world) {
    double utls = 0.0;
    double wctls = 1.0;
    for (const PublishedArea& area : published_wctls_areas()) {
      if (area.environment != world) continue;
      if (area.method == "utls") utls = area.area;
      if (area.method == "wctls") wctls = area.area;
    }
    return utls / wctls;
  }

  static nlohmann::ordered_json environment_json(const WctlsPaperEnvironment& result) {
    auto corners = nlohmann::ordered_json::array();
    for (const Eigen::Vector2d& corner : result.truth) {
      corners.push_back({{"x", corner.x()}, {"y", corner.y()}});
    }
    auto methods = nlohmann::ordered_json::array();
    for (const WctlsPaperMethod& method : result.methods) {
      const Sigmas sigmas = sigmas_of(method);
      methods.push_back({{"fitter", method.fitter},
                         {"covariance", enum_name(method.covariance)},
                         {"sigma_x", json_of(sigmas.x)},
                         {"sigma_y", json_of(sigmas.y)},
                         {"median_ellipse_areas", method.median_areas}});
    }
    return {{"environment", result.world},   {"points", result.rays},
            {"scans", result.scans},         {"representative_scan", result.representative},
            {"corners", std::move(corners)}, {"methods", std::move(methods)}};
  }

  void add_comparisons(nlohmann::ordered_json& report, std::size_t k) const {
    const PublishedTable& table = tables_[k];
    const WctlsPaperEnvironment& result = results_[k];
    const auto in_millimetres = [](std::optional<double> metres) {
      return metres ? std::optional(1e3 * *metres) : std::nullopt;
    };
    for (const CovarianceMode mode : modes) {
      const std::string as = ", " + std::string(enum_name(mode)) + " here";
      for (const PublishedSigmas& published : table.methods) {
        const Sigmas sigmas = sigmas_of(method_of(result, published.method, mode));
        const std::string of = " over the corners, " + published.method + ", " + table.environment;
        add_published(report, {table.paper, table.place, "median sigma_x" + of + as, "mm",
                               median(published.x), in_millimetres(median_of(sigmas.x))});
        add_published(report, {table.paper, table.place, "median sigma_y" + of + as, "mm",
                               median(published.y), in_millimetres(median_of(sigmas.y))});
      }
      std::string paper, place;
      for (const PublishedArea& area : published_wctls_areas()) {
        if (area.environment != table.environment) continue;
        paper = area.paper;
        place = area.place;
        add_published(
            report, {paper, place,
                     "median ellipse area per scan, " + area.method + ", " + area.environment + as,
                     "mm^2", area.area, area_of(result, area.method, mode)});
      }
      add_published(report, {paper, place, "ratio of areas utls / wctls, " + table.environment + as,
                             "1", published_ratio(table.environment), ratio(result, mode)});
    }
  }

  void write_environment(HtmlPage& page, std::size_t k) const {
    const WctlsPaperEnvironment& result = results_[k];
    page.heading(3, result.world + " (" + tables_[k].place + ")");
    write_sigmas(page, tables_[k], result);
    DrawingOptions options;
    options.ellipse_scale = expansion;
    for (const CovarianceMode mode : modes) {
      page.figure(draw_svg(ellipses(result, mode), options),
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

  static void write_sigmas(HtmlPage& page, const PublishedTable& published,
                           const WctlsPaperEnvironment& result) {
    page.paragraph("Standard deviations [mm] of the corners of one scan (number " +
                   std::to_string(result.representative) + " of " + std::to_string(result.scans) +
                   ", the first with most corners), clockwise, beside the paper's " +
                   published.place +
                   ". The corners are not the same corners: what can be compared is the medians "
                   "in the last row. - marks a corner that was not found.");
    HtmlTable table;
    table.last_row_is_summary = true;
    table.groups = {{"", 1}};
    table.head = {"corner"};
    std::vector<std::vector<double>> columns;  // [mm]
    for (const CovarianceMode mode : modes) {
      for (const char* fitter : fitters) {
        Sigmas sigmas = sigmas_of(method_of(result, fitter, mode));
        for (auto* values : {&sigmas.x, &sigmas.y}) {
          for (double& value : *values) value *= 1e3;
          columns.push_back(std::move(*values));
        }
      }
      table.groups.emplace_back("here, " + std::string(enum_name(mode)), 2 * fitters.size());
    }
    for (const PublishedSigmas& method : published.methods) {
      columns.push_back(method.x);
      columns.push_back(method.y);
    }
    table.groups.emplace_back("the paper's " + published.place, 2 * published.methods.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string name = fitters.at(i / 2 % fitters.size());
      table.head.push_back(name + (i % 2 == 0 ? " x" : " y"));
    }
    std::size_t rows = 0;
    for (const auto& column : columns) rows = std::max(rows, column.size());
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<std::string> cells{std::to_string(row + 1)};
      for (const auto& column : columns) {
        cells.push_back(row < column.size() ? text(column[row], 1) : "");
      }
      table.rows.push_back(std::move(cells));
    }
    std::vector<std::string> medians{"median"};
    for (const auto& column : columns) medians.push_back(text(median_of(column), 1));
    table.rows.push_back(std::move(medians));
    page.table(table);
  }

  static Drawing ellipses(const WctlsPaperEnvironment& result, CovarianceMode mode) {
    Drawing drawing;
    drawing.title = "Corner uncertainty in " + result.world + ", " + std::string(enum_name(mode));
    drawing.caption = "covariances from " + noise_text(data_sheet_model());
    drawing.ellipses = "one-sigma ellipses";
    for (const Eigen::Vector2d& point : result.points) drawing.points.push_back(drawn(point));
    for (const LineSegment& line : result.lines) {
      drawing.lines.push_back({drawn(line.start), drawn(line.end)});
    }
    // The largest first, so that none hides another; in the paper's colours wctls is red.
    const std::array<const char*, 3> order{"wctls", "wtls", "utls"};
    for (std::size_t k = 0; k < order.size(); ++k) {
      drawing.series.emplace_back(order.at(k));
      for (const auto& corner : method_of(result, order.at(k), mode).corners) {
        if (corner) drawing.corners.push_back(drawn(*corner, 1.0, k));
      }
    }
    return drawing;
  }

  static BoxPlot areas(const WctlsPaperEnvironment& result) {
    BoxPlot plot{"Median ellipse area per scan, " + result.world,
                 {"median one-sigma ellipse area [mm^2]", true},
                 {fitters.begin(), fitters.end()},
                 {},
                 {}};
    for (const CovarianceMode mode : modes) {
      BoxSeries series{"here, " + std::string(enum_name(mode)), {}};
      for (const char* fitter : fitters) {
        std::vector<double> values = method_of(result, fitter, mode).median_areas;
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

  static void write_areas(HtmlPage& page, const WctlsPaperEnvironment& result) {
    HtmlTable table{
        {},
        {"median ellipse area [mm^2]", "the paper", "here, as_published", "here, propagated"},
        {},
        1,
        true};
    const auto cell = [&](const std::string& fitter, CovarianceMode mode) {
      const std::vector<double>& values = method_of(result, fitter, mode).median_areas;
      return text(area_of(result, fitter, mode), 1) + " +- " +
             fixed(square_millimetres * standard_deviation(values), 1);
    };
    for (const PublishedArea& area : published_wctls_areas()) {
      if (area.environment != result.world) continue;
      table.rows.push_back({area.method, fixed(area.area, 1) + " +- " + fixed(area.spread, 1),
                            cell(area.method, CovarianceMode::as_published),
                            cell(area.method, CovarianceMode::propagated)});
    }
    table.rows.push_back({"utls / wctls", fixed(published_ratio(result.world), 2),
                          text(ratio(result, CovarianceMode::as_published), 2),
                          text(ratio(result, CovarianceMode::propagated), 2)});
    page.table(table);
  }

  std::uint64_t seed_;
  SensorModel noise_ = rplidar_noise(0.010);
  std::vector<PublishedTable> tables_;
  std::vector<WctlsPaperEnvironment> results_;
};

}  // namespace

std::unique_ptr<Section> make_wctls_paper_section(const EvaluationSetup& setup) {
  return std::make_unique<WctlsPaperSection>(setup);
}

}  // namespace quoin::deploy
