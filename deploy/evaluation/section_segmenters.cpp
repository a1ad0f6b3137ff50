// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/evaluation/fit_timing.hpp"
#include "core/evaluation/segmentation_quality.hpp"
#include "core/extraction/extraction.hpp"
#include "core/geometry/angle.hpp"
#include "core/simulation/world.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::array range_stddevs{0.003, 0.010, 0.020, 0.050};  // [m]
constexpr std::size_t timed_scans = 20;
// Rooms differ more than scans of one room: many rooms, and a tenth of the scans of each.
constexpr std::size_t cluttered_room_count = 200;
constexpr std::size_t fewer_scans = 10;

struct Entry {
  std::string segmenter;
  SensorModel noise;
  SegmentationQuality result;
  std::optional<double> scans_per_second;
};

class SegmentersSection : public Section {
 public:
  explicit SegmentersSection(const EvaluationSetup& setup)
      : scans_(setup.worlds.empty()
                   ? std::max<std::size_t>(1, setup.options.scans_per_world / fewer_scans)
                   : setup.options.scans_per_world),
        seed_(setup.options.seed),
        worlds_(setup.worlds.empty()
                    ? cluttered_rooms(cluttered_room_count,
                                      derived_seed(setup.options.seed, "cluttered_rooms"))
                    : setup.worlds),
        places_(setup.worlds.empty() ? " rooms with furniture and clutter" : " worlds"),
        segmenters_(setup.segmenters) {
    for (const std::string& segmenter : segmenters_) {
      for (const double range_stddev : range_stddevs) {
        entries_.push_back({segmenter, rplidar_noise(range_stddev), {}, std::nullopt});
      }
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (Entry& entry : entries_) {
      jobs.push_back(
          {entry.segmenter + " at " + noise_text(entry.noise), [this, &entry](const auto& stop) {
             entry.result = judge_segmentation(stoppable(make_segmenter(entry.segmenter), stop),
                                               worlds_, entry.noise, scans_, seed_of(entry));
           }});
    }
    return jobs;
  }

  std::vector<Job> timing_jobs() override {
    std::vector<Job> jobs;
    for (Entry& entry : entries_) {
      jobs.push_back({"speed of " + entry.segmenter,
                      [this, &entry](const auto& stop) { measure_speed(entry, stop); }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& array = report["segmenters"] = nlohmann::ordered_json::array();
    for (const Entry& entry : entries_) {
      const SegmentationQuality& result = entry.result;
      nlohmann::ordered_json object{{"name", entry.segmenter},
                                    {"range_stddev", entry.noise.range_stddev},
                                    {"bearing_stddev", entry.noise.bearing_stddev},
                                    {"scans", result.scans},
                                    {"true_segments", result.true_segments},
                                    {"found_segments", result.found_segments},
                                    {"matches", result.matches}};
      add_interval(object, "true_positive_rate", result.true_positive_rate);
      add_interval(object, "false_positive_rate", result.false_positive_rate);
      object["alpha_stddev"] = result.alpha_stddev;
      object["r_stddev"] = result.r_stddev;
      object["scans_per_second"] = nullptr;
      if (entry.scans_per_second) object["scans_per_second"] = *entry.scans_per_second;
      array.push_back(std::move(object));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "The measures of Nguyen et al. 2007 on simulated scans whose true segments are known, " +
        std::to_string(scans_) + " scans of each of " + std::to_string(worlds_.size()) + places_ +
        ": true positives among the true segments, false positives among the found ones, "
        "and how far the lines of matched segments scatter around the true ones. Bearing noise is "
        "0.113 deg.");
    page.figure(
        plot_svg(rate_chart("True positive rate", &SegmentationQuality::true_positive_rate)),
        "Share of the true segments that were found; more is better.");
    page.figure(
        plot_svg(rate_chart("False positive rate", &SegmentationQuality::false_positive_rate)),
        "Share of the found segments that are none; less is better.");
    page.figure(plot_svg(scatter_chart("Scatter of alpha", "alpha [deg]",
                                       &SegmentationQuality::alpha_stddev, degrees)),
                "Standard deviation of the direction of matched segments' lines.");
    page.figure(
        plot_svg(scatter_chart("Scatter of r", "r [mm]", &SegmentationQuality::r_stddev, 1e3)),
        "Standard deviation of the distance of matched segments' lines.");
    HtmlTable table{{},
                    {"segmenter", "range noise [mm]", "true positives [%]", "false positives [%]",
                     "alpha [deg]", "r [mm]", "scans/s"},
                    {},
                    1};
    for (const Entry& entry : entries_) {
      const SegmentationQuality& result = entry.result;
      table.rows.push_back({entry.segmenter, fixed(1e3 * entry.noise.range_stddev, 0),
                            interval_text(result.true_positive_rate, 1, 100.0),
                            interval_text(result.false_positive_rate, 1, 100.0),
                            fixed(result.alpha_stddev * degrees, 3),
                            fixed(result.r_stddev * 1e3, 2),
                            entry.scans_per_second ? fixed(*entry.scans_per_second, 0) : "-"});
    }
    page.table(table);
  }

  SummaryTable summary() const override {
    std::string noises;
    for (const double stddev : range_stddevs) {
      noises += (noises.empty() ? "" : " / ") + fixed(1e3 * stddev, 0);
    }
    SummaryTable rows{
        {"at " + noises + " mm", "true positives [%]", "false positives [%]", "1000 scans/s"}};
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const Entry& entry = entries_[k];
      const bool first = k % range_stddevs.size() == 0;
      if (first) rows.push_back({entry.segmenter, "", "", ""});
      const std::string between = first ? "" : " / ";
      rows.back()[1] += between + fixed(100.0 * entry.result.true_positive_rate.value, 1);
      rows.back()[2] += between + fixed(100.0 * entry.result.false_positive_rate.value, 1);
      rows.back()[3] +=
          between + (entry.scans_per_second ? fixed(1e-3 * *entry.scans_per_second, 1) : "-");
    }
    return rows;
  }

 private:
  /// All segmenters are given the same scans.
  [[nodiscard]] std::uint64_t seed_of(const Entry& entry) const {
    return derived_seed(seed_, "segmenters/" + noise_text(entry.noise));
  }

  void measure_speed(Entry& entry, const std::stop_token& stop) const {
    std::vector<Points> scans;
    SimulatedScan scan;
    for (std::size_t k = 0; k < timed_scans; ++k) {
      const World& world = worlds_[k % worlds_.size()];
      ScannerSettings settings;
      settings.points = rays_per_revolution(world.name);
      settings.noise = entry.noise;
      SimulatedScanner scanner(world, settings, derived_seed(seed_of(entry), std::to_string(k)));
      scanner.scan(0.0, 0.0, scan);
      convert(view(scan, settings), scans.emplace_back());
    }
    const Segmenter segmenter = stoppable(make_segmenter(entry.segmenter), stop);
    Segmentation found;
    const double seconds = seconds_per_call([&] {
      for (const Points& points : scans) segmenter(points, entry.noise, found);
    });
    entry.scans_per_second = static_cast<double>(scans.size()) / seconds;
  }

  [[nodiscard]] IntervalChart rate_chart(const std::string& title,
                                         Interval SegmentationQuality::*rate) const {
    IntervalChart chart{title, {title + " [%]"}, segmenters_, {}, std::nullopt, ""};
    for (std::size_t noise = 0; noise < range_stddevs.size(); ++noise) {
      IntervalSeries series{fixed(1e3 * range_stddevs.at(noise), 0) + " mm", {}};
      for (std::size_t k = noise; k < entries_.size(); k += range_stddevs.size()) {
        series.values.emplace_back(plotted(entries_[k].result.*rate, 100.0));
      }
      chart.series.push_back(std::move(series));
    }
    return chart;
  }

  [[nodiscard]] LineChart scatter_chart(const std::string& title, const std::string& unit,
                                        double SegmentationQuality::*stddev, double factor) const {
    LineChart chart{title + " against range noise", {"range noise [mm]", true}, {unit, true}, {}};
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (k % range_stddevs.size() == 0) chart.series.push_back({entries_[k].segmenter, {}, {}});
      chart.series.back().x.push_back(1e3 * entries_[k].noise.range_stddev);
      chart.series.back().y.push_back(factor * entries_[k].result.*stddev);
    }
    return chart;
  }

  std::size_t scans_;
  std::uint64_t seed_;
  std::vector<World> worlds_;
  std::string places_;  // what the worlds are
  std::vector<std::string> segmenters_;
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<Section> make_segmenters_section(const EvaluationSetup& setup) {
  return std::make_unique<SegmentersSection>(setup);
}

}  // namespace quoin::deploy
