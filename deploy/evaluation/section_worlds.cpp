// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/loop_coverage.hpp"
#include "core/fitting/fitters.hpp"
#include "core/simulation/random_worlds.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t world_count = 40;  // of each style
// Worlds differ more than scans of one world: many worlds, and a quarter of the scans of each.
constexpr std::size_t fewer_scans = 4;
/// Observations of one corner from which on its own coverage is shown: to 1 % of standard error.
constexpr std::size_t judged_observations = 500;
constexpr std::array range_stddevs{0.010, 0.030};                 // [m]
constexpr std::array<std::size_t, 4> few_rays{360, 120, 64, 32};  // per revolution
constexpr std::size_t usual_rays = DisturbedScans{}.rays;

/// Lowest and highest coverage of the corners that were observed often enough.
struct CornerRange {
  std::size_t corners = 0;
  double lowest = 1.0;
  double highest = 0.0;
  double beyond_four_sigma = 0.0;  ///< the largest share

  explicit CornerRange(const CornerQuality& quality) {
    for (const CornerCoverage& corner : quality.corners) {
      if (corner.observations < judged_observations) continue;
      ++corners;
      lowest = std::min(lowest, corner.coverage());
      highest = std::max(highest, corner.coverage());
      beyond_four_sigma =
          std::max(beyond_four_sigma, static_cast<double>(corner.beyond_four_sigma) /
                                          static_cast<double>(corner.observations));
    }
  }
};

struct Entry {
  std::string segmenter;
  std::string name;
  std::size_t worlds = 0;  ///< index into the sets
  DisturbedScans disturbed;
  LoopCoverage result;
};

std::string disturbance_text(const DisturbedScans& disturbed) {
  std::string text;
  if (disturbed.strays > 0.0) text += fixed(100.0 * disturbed.strays, 0) + " % strays";
  if (disturbed.dropout > 0.0) {
    text += (text.empty() ? "" : ", ") + fixed(100.0 * disturbed.dropout, 0) + " % drop-outs";
  }
  return text.empty() ? "-" : text;
}

class WorldsSection : public Section {
 public:
  explicit WorldsSection(const EvaluationSetup& setup)
      : seed_(setup.options.seed),
        fitter_(setup.options.fitters.empty() ? Fitters::descriptions().front().name
                                              : setup.fitters.front()),
        own_(setup.worlds.empty()) {
    scans_ = own_ ? std::max<std::size_t>(1, setup.options.scans_per_world / fewer_scans)
                  : setup.options.scans_per_world;
    if (own_) {
      for (const auto& [style, name] : EnumNames<WorldStyle>::names) {
        sets_.push_back(
            random_worlds(style, world_count, derived_seed(seed_, "worlds/" + std::string(name))));
      }
    } else {
      for (const World& world : setup.worlds) sets_.push_back({world});
    }
    for (const std::string& segmenter : setup.loop_segmenters) add_entries(segmenter);
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (Entry& entry : entries_) {
      jobs.push_back(
          {entry.name + " with " + std::to_string(entry.disturbed.rays) + " rays at " +
               noise_text(entry.disturbed.noise),
           [this, &entry](const auto& stop) {
             Extraction extraction(
                 stoppable(make_segmenter(entry.segmenter), stop),
                 make_fitter(fitter_, covariance_modes(fitter_).front()),
                 CornerFinders::make<CornerFinder>(CornerFinders::descriptions().front().name, {}));
             entry.result = judge_loop(extraction, sets_[entry.worlds], entry.disturbed);
           }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& array = report["worlds"] = nlohmann::ordered_json::array();
    for (const Entry& entry : entries_) {
      const CornerRange range(entry.result.corners);
      nlohmann::ordered_json object{{"name", entry.name},
                                    {"worlds", sets_[entry.worlds].size()},
                                    {"segmenter", entry.segmenter},
                                    {"fitter", fitter_},
                                    {"rays", entry.disturbed.rays},
                                    {"range_stddev", entry.disturbed.noise.range_stddev},
                                    {"bearing_stddev", entry.disturbed.noise.bearing_stddev},
                                    {"strays", entry.disturbed.strays},
                                    {"dropout", entry.disturbed.dropout},
                                    {"scans", entry.result.scans}};
      add_loop_coverage(object, entry.result);
      object["judged_corners"] = range.corners;
      object["judged_corners_coverage95"] = nullptr;
      object["judged_corners_beyond_four_sigma"] = nullptr;
      if (range.corners > 0) {
        object["judged_corners_coverage95"] = {range.lowest, range.highest};
        object["judged_corners_beyond_four_sigma"] = range.beyond_four_sigma;
      }
      object["failures"] = failures_json(entry.result.failures);
      array.push_back(std::move(object));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        (own_ ? "Rooms, flats and halls at random, " + std::to_string(world_count) +
                    " of each: slanted walls, niches, open doors, poles, partitions that end on "
                    "walls, columns, up to 30 m. "
              : std::string("The given worlds. ")) +
        std::to_string(scans_) + " scans of each world, from one place, extracted with " + fitter_ +
        ". " + loop_coverage_text + " Corners with at least " +
        std::to_string(judged_observations) +
        " observations are also judged one by one: the lowest and the highest coverage of them; "
        "--scans-per-world sets how many there are.");
    HtmlTable table{{},
                    {"worlds", "segmenter", "disturbed by", "rays", "noise [mm]", "recall [%]",
                     "precision [%]", "coverage [%]", "beyond 4 sigma [%]", "corners judged",
                     "their coverage [%]", "lines' coverage [%]", "false lines [%]"},
                    {},
                    3};
    for (const Entry& entry : entries_) {
      const CornerQuality& corners = entry.result.corners;
      const LineQuality& lines = entry.result.lines;
      const CornerRange range(corners);
      table.rows.push_back(
          {entry.name, entry.segmenter, disturbance_text(entry.disturbed),
           std::to_string(entry.disturbed.rays), fixed(1e3 * entry.disturbed.noise.range_stddev, 0),
           interval_text(corners.recall, 1, 100.0), interval_text(corners.precision, 2, 100.0),
           interval_text(corners.coverage, 1, 100.0), fixed(100.0 * corners.beyond_four_sigma, 2),
           std::to_string(range.corners), range_text(range),
           interval_text(lines.coverage, 1, 100.0),
           lines.lines > 0 ? fixed(100.0 * static_cast<double>(lines.false_lines) /
                                       static_cast<double>(lines.lines),
                                   2)
                           : "-"});
    }
    page.table(table);
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"worlds", "rays", "noise [mm]", "recall [%]", "precision [%]",
                       "coverage [%]", "beyond 4 sigma [%]", "each corner [%]",
                       "lines' coverage [%]"}};
    for (const Entry& entry : entries_) {
      const CornerQuality& corners = entry.result.corners;
      const std::string disturbed = disturbance_text(entry.disturbed);
      rows.push_back(
          {entry.name + (disturbed == "-" ? "" : ", " + disturbed),
           std::to_string(entry.disturbed.rays), fixed(1e3 * entry.disturbed.noise.range_stddev, 0),
           fixed(100.0 * corners.recall.value, 1), fixed(100.0 * corners.precision.value, 2),
           fixed(100.0 * corners.coverage.value, 1), fixed(100.0 * corners.beyond_four_sigma, 2),
           range_text(CornerRange(corners)), fixed(100.0 * entry.result.lines.coverage.value, 1)});
    }
    return rows;
  }

 private:
  static std::string range_text(const CornerRange& range) {
    if (range.corners == 0) return "-";
    return fixed(100.0 * range.lowest, 1) + " to " + fixed(100.0 * range.highest, 1);
  }

  void add_entries(const std::string& segmenter) {
    const auto add = [&](std::size_t set, std::size_t rays, double range_stddev, double strays,
                         double dropout) {
      const std::string name = own_ ? std::string(EnumNames<WorldStyle>::names.at(set).second) + "s"
                                    : sets_[set].front().name;
      DisturbedScans disturbed{rays,   rplidar_noise(range_stddev),           strays,
                               scans_, derived_seed(seed_, "worlds/" + name), dropout};
      entries_.push_back({segmenter, name, set, disturbed, {}});
    };
    for (std::size_t set = 0; set < sets_.size(); ++set) {
      const std::size_t rays = own_ ? usual_rays : rays_per_revolution(sets_[set].front().name);
      for (const double stddev : range_stddevs) add(set, rays, stddev, 0.0, 0.0);
    }
    if (!own_) return;
    add(0, usual_rays, 0.010, 0.03, 0.02);
    for (const std::size_t rays : few_rays) add(0, rays, 0.010, 0.0, 0.0);
  }

  std::uint64_t seed_;
  std::string fitter_;
  bool own_;  // worlds at random, not given ones
  std::size_t scans_ = 0;
  std::vector<std::vector<World>> sets_;
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<Section> make_worlds_section(const EvaluationSetup& setup) {
  return std::make_unique<WorldsSection>(setup);
}

}  // namespace quoin::deploy
