// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/loop_coverage.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

struct Entry {
  std::string segmenter;
  std::string fitter;
  std::string covariance;
  std::size_t world = 0;
  LoopCoverage result;
};

class LoopSection : public Section {
 public:
  explicit LoopSection(const EvaluationSetup& setup)
      : scans_(setup.options.scans_per_world),
        seed_(setup.options.seed),
        noise_(rplidar_noise(0.010)),
        worlds_(worlds_or(setup, world_names())),
        segmenters_(setup.loop_segmenters) {
    for (const std::string& segmenter : segmenters_) {
      for (const std::string& fitter : setup.fitters) {
        for (std::size_t world = 0; world < worlds_.size(); ++world) {
          entries_.push_back({segmenter, fitter, covariance_modes(fitter).front(), world, {}});
        }
      }
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (Entry& entry : entries_) {
      const World& world = worlds_[entry.world];
      jobs.push_back({entry.segmenter + " and " + entry.fitter + " in " + world.name,
                      [this, &entry, &world](const auto& stop) {
                        Extraction extraction(stoppable(make_segmenter(entry.segmenter), stop),
                                              make_fitter(entry.fitter, entry.covariance),
                                              CornerFinders::make<CornerFinder>(
                                                  CornerFinders::descriptions().front().name, {}));
                        // All methods are given the same scans.
                        entry.result =
                            judge_loop(extraction, {&world, 1},
                                       {.rays = rays_per_revolution(world.name),
                                        .noise = noise_,
                                        .scans = scans_,
                                        .seed = derived_seed(seed_, "loop/" + world.name)});
                      }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& array = report["loop"] = nlohmann::ordered_json::array();
    for (const Entry& entry : entries_) {
      const LoopCoverage& result = entry.result;
      nlohmann::ordered_json object{{"segmenter", entry.segmenter},
                                    {"fitter", entry.fitter},
                                    {"covariance", entry.covariance},
                                    {"environment", worlds_[entry.world].name},
                                    {"range_stddev", noise_.range_stddev},
                                    {"bearing_stddev", noise_.bearing_stddev},
                                    {"scans", result.scans},
                                    {"segments_per_scan", result.segments_per_scan},
                                    {"corners_per_scan", result.corners_per_scan}};
      add_loop_coverage(object, result);
      object["failures"] = failures_json(result.failures);
      array.push_back(std::move(object));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "Simulated scans with noise of " + noise_text(noise_) + ", " + std::to_string(scans_) +
        " a world, segmented, fitted and intersected as the services do it. " + loop_coverage_text);
    for (const std::string& segmenter : segmenters_) write_segmenter(page, segmenter);
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"coverage [%]", "segmenter"}};
    for (const World& world : worlds_) rows[0].push_back(world.name);
    for (const Entry& entry : entries_) {
      if (entry.world == 0) rows.push_back({entry.fitter, entry.segmenter});
      rows.back().push_back(fixed(100.0 * entry.result.corners.coverage.value, 1));
    }
    return rows;
  }

 private:
  void write_segmenter(HtmlPage& page, const std::string& segmenter) const {
    page.heading(3, "Segmented by " + segmenter);
    IntervalChart chart = coverage_chart("segmented by " + segmenter);
    for (const World& world : worlds_) chart.series.push_back({world.name, {}});
    HtmlTable table{
        {},
        {"fitter", "environment", "segments/scan", "corners/scan", "recall [%]", "precision [%]",
         "coverage [%]", "NEES", "beyond 4 sigma [%]", "lines' coverage [%]", "failures"},
        {},
        2};
    for (const Entry& entry : entries_) {
      if (entry.segmenter != segmenter) continue;
      const LoopCoverage& result = entry.result;
      table.rows.push_back(
          {entry.fitter, worlds_[entry.world].name, fixed(result.segments_per_scan, 1),
           fixed(result.corners_per_scan, 1), fixed(100.0 * result.corners.recall.value, 1),
           fixed(100.0 * result.corners.precision.value, 1),
           interval_text(result.corners.coverage, 1, 100.0), interval_text(result.corners.nees, 2),
           fixed(100.0 * result.corners.beyond_four_sigma, 2),
           interval_text(result.lines.coverage, 1, 100.0), failures_text(result.failures)});
      if (chart.categories.empty() || chart.categories.back() != entry.fitter) {
        chart.categories.push_back(entry.fitter);
      }
      auto& values = chart.series[entry.world].values;
      values.resize(chart.categories.size());
      if (result.corners_per_scan > 0.0) values.back() = plotted(result.corners.coverage, 100.0);
    }
    page.figure(plot_svg(chart),
                "Points with 95 % confidence intervals; corners of one scan are not taken for "
                "independent.");
    page.table(table);
  }

  std::size_t scans_;
  std::uint64_t seed_;
  SensorModel noise_;
  std::vector<World> worlds_;
  std::vector<std::string> segmenters_;
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<Section> make_loop_section(const EvaluationSetup& setup) {
  return std::make_unique<LoopSection>(setup);
}

}  // namespace quoin::deploy
