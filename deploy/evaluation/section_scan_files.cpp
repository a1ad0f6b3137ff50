// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/fit_timing.hpp"
#include "core/evaluation/scan_consistency.hpp"
#include "core/evaluation/scan_statistics.hpp"
#include "deploy/evaluation/drawing/drawing.hpp"
#include "deploy/evaluation/drawing/plot.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/pictures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t timed_scans = 50;  // of the front of a file

struct Entry {
  std::size_t file = 0;
  std::string segmenter;
  std::string fitter;
  ScanFigures result;
  ScanConsistencyFigures consistency;
  std::optional<double> scans_per_second;
  Drawing picture;  // of the first scan that has corners
};

constexpr std::array split_test_titles{"odd and even points", "halves", "at rest"};

nlohmann::ordered_json distances_json(const DistanceFigures& modelled,
                                      const DistanceFigures& reported) {
  nlohmann::ordered_json object{{"lines", modelled.count}, {"inside95", nullptr}};
  if (modelled.count == 0) return object;
  add_interval(object, "inside95", modelled.inside95);
  object["median"] = modelled.median;
  object["mean"] = modelled.mean;
  add_interval(object, "reported_inside95", reported.inside95);
  object["reported_median"] = reported.median;
  return object;
}

/// Quantiles of what was measured against those of chi-square with two degrees of freedom.
LineChart quantile_chart(const ScanConsistencyFigures& figures) {
  LineChart chart{"Squared Mahalanobis distances of two lines of one wall",
                  {"expected of true covariances", true},
                  {"measured", true},
                  {}};
  const auto expected = [](double quantile) { return -2.0 * std::log(1.0 - quantile); };
  for (std::size_t test = 0; test < split_test_count; ++test) {
    const std::vector<double>& quantiles = figures.modelled.at(test).quantiles;
    if (quantiles.empty()) continue;
    LineSeries series{split_test_titles.at(test), {}, {}};
    for (std::size_t k = 0; k < quantiles.size(); ++k) {
      const auto count = static_cast<double>(quantiles.size());
      series.x.push_back(expected((static_cast<double>(k) + 0.5) / count));
      series.y.push_back(quantiles[k]);
    }
    chart.series.push_back(std::move(series));
  }
  const std::vector<double> ends{expected(0.01), expected(0.999)};
  if (!chart.series.empty()) chart.series.push_back({"true covariances", ends, ends});
  return chart;
}

ScanView view(const sensor_bridge::RecordedScan& scan) { return {scan.bearings, scan.ranges}; }

class ScanFilesSection : public Section {
 public:
  explicit ScanFilesSection(const EvaluationSetup& setup)
      : files_(setup.scan_files), sensor_(setup.options.scan_noise) {
    for (std::size_t file = 0; file < files_.size(); ++file) {
      for (const std::string& segmenter : setup.segmenters) {
        for (const std::string& fitter : setup.fitters) {
          entries_.push_back({file, segmenter, fitter, {}, {}, std::nullopt, {}});
        }
      }
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (Entry& entry : entries_) {
      jobs.push_back({name_of(entry), [this, &entry](const auto& stop) { extract(entry, stop); }});
    }
    return jobs;
  }

  std::vector<Job> timing_jobs() override {
    std::vector<Job> jobs;
    for (Entry& entry : entries_) {
      jobs.push_back({"speed of " + name_of(entry), [this, &entry](const auto& stop) {
                        Extraction extraction = make_extraction(entry, stop);
                        const auto& scans = files_[entry.file].scans;
                        const std::size_t count = std::min(scans.size(), timed_scans);
                        const double seconds = seconds_per_call([&] {
                          for (std::size_t k = 0; k < count; ++k) {
                            extraction.run(view(scans[k]), sensor_, sensor_);
                          }
                        });
                        entry.scans_per_second = static_cast<double>(count) / seconds;
                      }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& array = report["scan_files"] = nlohmann::ordered_json::array();
    for (const Entry& entry : entries_) {
      const ScanFigures& result = entry.result;
      nlohmann::ordered_json object{{"file", files_[entry.file].name},
                                    {"segmenter", entry.segmenter},
                                    {"fitter", entry.fitter},
                                    {"range_stddev", sensor_.range_stddev},
                                    {"bearing_stddev", sensor_.bearing_stddev},
                                    {"scans", result.scans},
                                    {"segments_per_scan", result.segments_per_scan},
                                    {"corners_per_scan", result.corners_per_scan},
                                    {"median_sigma", result.median_sigma},
                                    {"median_ellipse_area", result.median_ellipse_area},
                                    {"median_reduced_chi_square", result.median_reduced_chi_square},
                                    {"failures", failures_json(result.failures)},
                                    {"scans_per_second", nullptr}};
      if (entry.scans_per_second) object["scans_per_second"] = *entry.scans_per_second;
      object["consistency"] = consistency_json(entry.consistency);
      array.push_back(std::move(object));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph("Recorded scans, of which the truth is not known. The sensor model is " +
                   noise_text(sensor_) +
                   "; a reduced chi-square above 1 means that the walls are less straight or the "
                   "noise is larger than that, below 1 the opposite.");
    page.paragraph(
        "Consistency without truth: two lines are fitted to disjoint points of one wall of at "
        "least 20 points and compared at its middle, not by distance from the sensor, where "
        "a change of direction is no longer of first order. With true covariances 95 % of the "
        "pairs lie inside their 95 % bound, the median of the squared Mahalanobis distance is "
        "1.39. "
        "Odd and even points differ by the noise of single rays. Halves differ by all that "
        "neighbouring points share, too: walls that are not flat, motion, bearings that err "
        "slowly. "
        "Consecutive scans of a sensor at rest differ by its repeatability. The flatness of walls "
        "is "
        "left out of the covariances where both lines share it. 'as reported' is with covariances "
        "scaled to the residuals, as the services publish them. Intervals take 20 stretches of a "
        "file for independent.");
    for (std::size_t file = 0; file < files_.size(); ++file) {
      page.heading(3, files_[file].name);
      HtmlTable table{
          {},
          {"segmenter", "fitter", "scans", "segments/scan", "corners/scan", "median sigma [mm]",
           "median area [mm^2]", "reduced chi-square", "scans/s", "failures"},
          {},
          2};
      for (const Entry& entry : entries_) {
        if (entry.file != file) continue;
        const ScanFigures& result = entry.result;
        table.rows.push_back({entry.segmenter, entry.fitter, std::to_string(result.scans),
                              fixed(result.segments_per_scan, 1), fixed(result.corners_per_scan, 2),
                              fixed(1e3 * result.median_sigma, 2),
                              fixed(1e6 * result.median_ellipse_area, 1),
                              fixed(result.median_reduced_chi_square, 2),
                              entry.scans_per_second ? fixed(*entry.scans_per_second, 0) : "-",
                              failures_text(result.failures)});
      }
      page.table(table);
      write_consistency(page, file);
      const auto shown = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.file == file && !entry.picture.points.empty();
      });
      if (shown == entries_.end()) continue;
      page.figure(draw_svg(shown->picture), "The first scan with corners, by " + shown->segmenter +
                                                " and " + shown->fitter + ".");
    }
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"file", "segmenter", "fitter", "scans", "corners/scan", "sigma [mm]",
                       "reduced chi-square", "odd/even [%]", "halves [%]", "at rest [%]",
                       "scans/s"}};
    for (const Entry& entry : entries_) {
      const ScanFigures& result = entry.result;
      rows.push_back({files_[entry.file].name, entry.segmenter, entry.fitter,
                      std::to_string(result.scans), fixed(result.corners_per_scan, 2),
                      fixed(1e3 * result.median_sigma, 2),
                      fixed(result.median_reduced_chi_square, 2)});
      for (const DistanceFigures& test : entry.consistency.modelled) {
        rows.back().push_back(test.count > 0 ? fixed(100.0 * test.inside95.value, 1) : "-");
      }
      rows.back().push_back(entry.scans_per_second ? fixed(*entry.scans_per_second, 0) : "-");
    }
    return entries_.empty() ? SummaryTable{} : rows;
  }

 private:
  [[nodiscard]] std::string name_of(const Entry& entry) const {
    return entry.segmenter + " and " + entry.fitter + " on " + files_[entry.file].name;
  }

  static nlohmann::ordered_json consistency_json(const ScanConsistencyFigures& figures) {
    nlohmann::ordered_json object{{"lines", figures.lines},
                                  {"scans_at_rest", figures.scans_at_rest}};
    add_interval(object, "reduced_chi_square", figures.reduced_chi_square);
    for (const auto& [test, name] : EnumNames<SplitTest>::names) {
      const auto k = static_cast<std::size_t>(test);
      object[std::string(name)] = distances_json(figures.modelled.at(k), figures.reported.at(k));
    }
    return object;
  }

  void write_consistency(HtmlPage& page, std::size_t file) const {
    HtmlTable table{{{"", 3}}, {"segmenter", "fitter", "reduced chi-square"}, {}, 2};
    for (const char* title : split_test_titles) {
      table.groups.emplace_back(title, 4);
      table.head.insert(table.head.end(),
                        {"walls", "inside 95 % [%]", "median", "as reported [%]"});
    }
    const Entry* shown = nullptr;
    for (const Entry& entry : entries_) {
      if (entry.file != file) continue;
      if (shown == nullptr) shown = &entry;
      const ScanConsistencyFigures& figures = entry.consistency;
      table.rows.push_back(
          {entry.segmenter, entry.fitter, interval_text(figures.reduced_chi_square, 2)});
      for (std::size_t test = 0; test < split_test_count; ++test) {
        const DistanceFigures& modelled = figures.modelled.at(test);
        const bool any = modelled.count > 0;
        auto& row = table.rows.back();
        row.push_back(std::to_string(modelled.count));
        row.push_back(any ? interval_text(modelled.inside95, 1, 100.0) : "-");
        row.push_back(any ? fixed(modelled.median, 2) : "-");
        row.push_back(any ? interval_text(figures.reported.at(test).inside95, 1, 100.0) : "-");
      }
    }
    page.table(table);
    if (shown == nullptr) return;
    const LineChart chart = quantile_chart(shown->consistency);
    if (chart.series.empty()) return;
    page.figure(plot_svg(chart), "Quantiles, by " + shown->segmenter + " and " + shown->fitter +
                                     "; above the line of true covariances they are too small, "
                                     "below too large.");
  }

  static Extraction make_extraction(const Entry& entry, const std::stop_token& stop) {
    return {stoppable(make_segmenter(entry.segmenter), stop),
            make_fitter(entry.fitter, covariance_modes(entry.fitter).front()),
            CornerFinders::make<CornerFinder>(CornerFinders::descriptions().front().name, {})};
  }

  /// Where the robot was, as far as the recording knows.
  static std::optional<Pose2> pose_of(const sensor_bridge::RecordedScan& scan) {
    if (scan.pose || scan.odometry.empty()) return scan.pose;
    return scan.odometry.back().pose;
  }

  void extract(Entry& entry, const std::stop_token& stop) const {
    Extraction extraction = make_extraction(entry, stop);
    ScanStatistics statistics;
    ScanConsistency consistency(make_fitter(entry.fitter, covariance_modes(entry.fitter).front()),
                                sensor_);
    const ScanFile& file = files_[entry.file];
    for (std::size_t k = 0; k < file.scans.size(); ++k) {
      extraction.run(view(file.scans[k]), sensor_, sensor_);
      statistics.add(extraction, sensor_);
      const sensor_bridge::RecordedScan& scan = file.scans[k];
      if (scan.first_of_file) consistency.begin_recording();
      consistency.add(extraction, pose_of(scan));
      if (!entry.picture.points.empty() || extraction.corners().empty()) continue;
      entry.picture = picture(extraction);
      entry.picture.title = "scan " + std::to_string(k);
      entry.picture.caption = file.name;
    }
    entry.result = statistics.figures();
    entry.consistency = consistency.figures();
  }

  std::vector<ScanFile> files_;
  SensorModel sensor_;
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<Section> make_scan_files_section(const EvaluationSetup& setup) {
  return std::make_unique<ScanFilesSection>(setup);
}

}  // namespace quoin::deploy
