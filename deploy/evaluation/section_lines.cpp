// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/evaluation/line_coverage.hpp"
#include "core/fitting/fitters.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::array lengths{0.2, 0.3, 0.5, 1.0, 2.0, 5.0, 10.0};      // [m]
constexpr std::array distances{0.5, 1.0, 2.0, 4.0, 7.0, 10.0};         // [m]
constexpr std::array incidences{0.0, 40.0, 70.0};                      // [deg]
constexpr std::array wall_stddevs{0.003, 0.010, 0.020, 0.030, 0.050};  // [m]
constexpr std::size_t wall_rays = 920;
constexpr std::size_t fewest_points = 5;
// The segmenters take no wall that is shorter than their tolerance is wide: four standard
// deviations to either side.
constexpr double shortest_in_stddevs = 8.0;

struct WallEntry {
  SingleWall wall;
  double range_stddev = 0.0;  // [m]
  LineCoverage result;

  /// Whether the wall is met by enough rays in every trial.
  [[nodiscard]] bool counts() const { return result.trials > 0 && result.few_rays == 0; }
  [[nodiscard]] std::string identity() const {
    return "lines/" + noise_text(rplidar_noise(range_stddev)) + "/" + fixed(wall.incidence, 2) +
           "/" + fixed(wall.length, 1) + "/" + fixed(wall.distance, 1);
  }
  [[nodiscard]] bool is_short() const { return wall.length < shortest_in_stddevs * range_stddev; }
};

std::string percent(double share) { return fixed(100.0 * share, 1); }

class LinesSection : public Section {
 public:
  explicit LinesSection(const EvaluationSetup& setup)
      : trials_(2 * setup.options.trials), seed_(setup.options.seed) {
    for (const double stddev : wall_stddevs) {
      for (const double incidence : incidences) {
        for (const double length : lengths) {
          for (const double distance : distances) {
            entries_.push_back({{length, distance, incidence / degrees}, stddev, {}});
          }
        }
      }
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (std::size_t first = 0; first < entries_.size(); first += distances.size()) {
      jobs.push_back({"walls of " + fixed(entries_[first].wall.length, 1) + " m",
                      [this, first](const auto& stop) {
                        const Fitter fitter = stoppable(
                            make_fitter(Fitters::descriptions().front().name, "propagated"), stop);
                        for (std::size_t k = first; k < first + distances.size(); ++k) {
                          WallEntry& entry = entries_[k];
                          entry.result = judge_wall(
                              fitter, entry.wall, rplidar_noise(entry.range_stddev), wall_rays,
                              fewest_points, trials_, derived_seed(seed_, entry.identity()));
                        }
                      }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& section = report["lines"] = nlohmann::ordered_json::array();
    for (const WallEntry& entry : entries_) {
      if (!entry.counts()) continue;
      nlohmann::ordered_json object{
          {"range_stddev", entry.range_stddev}, {"incidence", entry.wall.incidence},
          {"length", entry.wall.length},        {"distance", entry.wall.distance},
          {"points", entry.result.points},      {"trials", entry.result.trials},
          {"gaussian", entry.result.gaussian}};
      add_interval(object, "coverage_middle", entry.result.middle);
      add_interval(object, "coverage_alpha_r", entry.result.alpha_r);
      section.push_back(std::move(object));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph("Walls one at a time, seen by " + std::to_string(wall_rays) +
                   " rays a revolution, by " + Fitters::descriptions().front().name +
                   ": share [%] of " + std::to_string(trials_) +
                   " trials in which direction and offset at the mid-point are "
                   "inside their 95 % ellipse "
                   "(standard error " +
                   fixed(100.0 * standard_error(), 2) +
                   " %). In brackets the same of (alpha, r), of the lines that "
                   "are said to be Gaussian in it; "
                   "no bracket where fewer than half are. Empty where some "
                   "trials have fewer than " +
                   std::to_string(fewest_points) +
                   " points; * walls shorter than eight standard deviations of "
                   "the noise.");
    HtmlTable table{{{"", 3}, {"distance of the mid-point", distances.size()}},
                    {"noise [mm]", "incidence [deg]", "length [m]"},
                    {},
                    0};
    for (const double distance : distances) table.head.push_back(fixed(distance, 1) + " m");
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const WallEntry& entry = entries_[k];
      if (k % distances.size() == 0) {
        table.rows.push_back({fixed(1e3 * entry.range_stddev, 0),
                              fixed(degrees * entry.wall.incidence, 0),
                              fixed(entry.wall.length, 1)});
      }
      table.rows.back().push_back(cell(entry));
    }
    page.table(table);
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"lines", "cells", "coverage [%]", "lowest", "highest", "beyond 94..96 %"}};
    for (const double stddev : wall_stddevs) {
      rows.push_back(summary_of(fixed(1e3 * stddev, 0) + " mm", [stddev](const WallEntry& entry) {
        return entry.range_stddev == stddev && !entry.is_short();
      }));
    }
    rows.push_back(summary_of("shorter than 8 stddev",
                              [](const WallEntry& entry) { return entry.is_short(); }));
    return rows;
  }

 private:
  [[nodiscard]] double standard_error() const {
    return std::sqrt(0.95 * 0.05 / static_cast<double>(trials_));
  }

  static std::string cell(const WallEntry& entry) {
    if (!entry.counts()) return "";
    std::string text = percent(entry.result.middle.value);
    if (entry.result.gaussian >= 0.5) text += " (" + percent(entry.result.alpha_r.value) + ")";
    return entry.is_short() ? text + " *" : text;
  }

  template <class Condition>
  std::vector<std::string> summary_of(const std::string& name, const Condition& condition) const {
    std::size_t cells = 0, beyond = 0;
    double sum = 0.0, lowest = 1.0, highest = 0.0;
    for (const WallEntry& entry : entries_) {
      if (!entry.counts() || !condition(entry)) continue;
      const double coverage = entry.result.middle.value;
      ++cells;
      sum += coverage;
      lowest = std::min(lowest, coverage);
      highest = std::max(highest, coverage);
      beyond += coverage < 0.94 || coverage > 0.96 ? 1 : 0;
    }
    if (cells == 0) return {name, "0", "", "", "", ""};
    return {name,
            std::to_string(cells),
            percent(sum / static_cast<double>(cells)),
            percent(lowest),
            percent(highest),
            std::to_string(beyond)};
  }

  std::size_t trials_;
  std::uint64_t seed_;
  std::vector<WallEntry> entries_;
};

}  // namespace

std::unique_ptr<Section> make_lines_section(const EvaluationSetup& setup) {
  return std::make_unique<LinesSection>(setup);
}

}  // namespace quoin::deploy
