// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/fit_timing.hpp"
#include "core/evaluation/scan_statistics.hpp"
#include "deploy/evaluation/drawing/drawing.hpp"
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
  std::optional<double> scans_per_second;
  Drawing picture;  // of the first scan that has corners
};

ScanView view(const sensor_bridge::RecordedScan& scan) { return {scan.bearings, scan.ranges}; }

class ScanFilesSection : public Section {
 public:
  explicit ScanFilesSection(const EvaluationSetup& setup)
      : files_(setup.scan_files), sensor_(rplidar_noise(0.010)) {
    for (std::size_t file = 0; file < files_.size(); ++file) {
      for (const std::string& segmenter : setup.segmenters) {
        for (const std::string& fitter : setup.fitters) {
          entries_.push_back({file, segmenter, fitter, {}, std::nullopt, {}});
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
      array.push_back(std::move(object));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph("Recorded scans, of which the truth is not known. The sensor model is " +
                   noise_text(sensor_) +
                   "; a reduced chi-square above 1 means that the walls are less straight or the "
                   "noise is larger than that, below 1 the opposite.");
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
                       "reduced chi-square", "scans/s"}};
    for (const Entry& entry : entries_) {
      const ScanFigures& result = entry.result;
      rows.push_back({files_[entry.file].name, entry.segmenter, entry.fitter,
                      std::to_string(result.scans), fixed(result.corners_per_scan, 2),
                      fixed(1e3 * result.median_sigma, 2),
                      fixed(result.median_reduced_chi_square, 2),
                      entry.scans_per_second ? fixed(*entry.scans_per_second, 0) : "-"});
    }
    return entries_.empty() ? SummaryTable{} : rows;
  }

 private:
  [[nodiscard]] std::string name_of(const Entry& entry) const {
    return entry.segmenter + " and " + entry.fitter + " on " + files_[entry.file].name;
  }

  static Extraction make_extraction(const Entry& entry, const std::stop_token& stop) {
    return {stoppable(make_segmenter(entry.segmenter), stop),
            make_fitter(entry.fitter, covariance_modes(entry.fitter).front()),
            CornerFinders::make<CornerFinder>(CornerFinders::descriptions().front().name, {})};
  }

  void extract(Entry& entry, const std::stop_token& stop) const {
    Extraction extraction = make_extraction(entry, stop);
    ScanStatistics statistics;
    const ScanFile& file = files_[entry.file];
    for (std::size_t k = 0; k < file.scans.size(); ++k) {
      extraction.run(view(file.scans[k]), sensor_, sensor_);
      statistics.add(extraction, sensor_);
      if (!entry.picture.points.empty() || extraction.corners().empty()) continue;
      entry.picture = picture(extraction);
      entry.picture.title = "scan " + std::to_string(k);
      entry.picture.caption = file.name;
    }
    entry.result = statistics.figures();
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
