// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/paper_corners.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/evaluation/wctls_paper_figures.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t scans = 100;  // as the paper

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
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      write_environment(page, tables_[k], results_[k]);
    }
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
      rows.push_back({result.world, "utls/wctls", fixed(published_area_ratio(result.world), 2),
                      text(area_ratio(result, CovarianceMode::as_published), 2),
                      text(area_ratio(result, CovarianceMode::propagated), 2)});
    }
    return rows;
  }

 private:
  void repeat(std::size_t k, const std::stop_token& stop) {
    const World world = built_in_world(tables_[k].environment).value();
    std::vector<NamedFitter> named;
    for (const CovarianceMode mode : paper_modes) {
      for (const char* fitter : wctls_paper_fitters) {
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

  static nlohmann::ordered_json environment_json(const WctlsPaperEnvironment& result) {
    auto methods = nlohmann::ordered_json::array();
    for (const WctlsPaperMethod& method : result.methods) {
      nlohmann::ordered_json object = sigmas_json(method);
      object["median_ellipse_areas"] = method.median_areas;
      methods.push_back(std::move(object));
    }
    return {{"environment", result.world},
            {"points", result.rays},
            {"scans", result.scans},
            {"representative_scan", result.representative},
            {"corners", positions_json(result.truth)},
            {"methods", std::move(methods)}};
  }

  void add_comparisons(nlohmann::ordered_json& report, std::size_t k) const {
    const PublishedTable& table = tables_[k];
    const WctlsPaperEnvironment& result = results_[k];
    add_published_sigmas(report, table, corners_in(result.methods), {"median", median_of});
    for (const CovarianceMode mode : paper_modes) {
      const std::string as = ", " + std::string(enum_name(mode)) + " here";
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
      add_published(report,
                    {paper, place, "ratio of areas utls / wctls, " + table.environment + as, "1",
                     published_area_ratio(table.environment), area_ratio(result, mode)});
    }
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
