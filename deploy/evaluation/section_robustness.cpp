// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/corner_quality.hpp"
#include "core/fitting/fitters.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::array<std::size_t, 7> ray_counts{3200, 920, 720, 450, 360, 240, 120};
constexpr std::array stray_shares{0.0, 0.03, 0.10};
constexpr std::array radii{0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 1.0, 1.5};  // [m]
constexpr std::array distances{0.5, 1.0, 2.0, 3.0, 5.0, 10.0};         // [m]
constexpr std::array range_stddevs{0.003, 0.010, 0.020, 0.030};        // [m]

struct Room {
  std::string segmenter;
  std::size_t rays = 0;
  double strays = 0.0;
  CornerQuality result;
};

struct Columns {
  std::string segmenter;
  double radius = 0.0;  // [m]
  double range_stddev = 0.0;
  std::size_t scans = 0;
  std::size_t false_corners = 0;

  [[nodiscard]] double false_per_100_scans() const {
    return 100.0 * static_cast<double>(false_corners) / static_cast<double>(scans);
  }
};

class RobustnessSection : public Section {
 public:
  explicit RobustnessSection(const EvaluationSetup& setup)
      : scans_(setup.options.scans_per_world), seed_(setup.options.seed) {
    for (const std::string& segmenter : setup.loop_segmenters) {
      for (const double strays : stray_shares) {
        for (const std::size_t rays : ray_counts) rooms_.push_back({segmenter, rays, strays, {}});
      }
      for (const double stddev : range_stddevs) {
        for (const double radius : radii) columns_.push_back({segmenter, radius, stddev, 0, 0});
      }
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (Room& room : rooms_) {
      jobs.push_back(
          {"a room with " + std::to_string(room.rays) + " rays", [this, &room](const auto& stop) {
             Extraction extraction = extraction_of(room.segmenter, stop);
             room.result =
                 judge_room_corners(extraction, {room.rays, rplidar_noise(0.010), room.strays,
                                                 scans_, derived_seed(seed_, "room"), 0.0});
           }});
    }
    for (Columns& columns : columns_) {
      jobs.push_back({"columns of " + fixed(columns.radius, 2) + " m",
                      [this, &columns](const auto& stop) { judge(columns, stop); }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& section = report["robustness"];
    auto& rooms = section["rooms"] = nlohmann::ordered_json::array();
    for (const Room& room : rooms_) {
      nlohmann::ordered_json object{
          {"segmenter", room.segmenter},
          {"rays", room.rays},
          {"strays", room.strays},
          {"true_corners", room.result.true_corners},
          {"false_corners_per_100_scans", room.result.false_per_100_scans()},
          {"nees", room.result.nees.value}};
      add_interval(object, "precision", room.result.precision);
      add_interval(object, "recall", room.result.recall);
      add_interval(object, "coverage", room.result.coverage);
      rooms.push_back(std::move(object));
    }
    auto& columns = section["columns"] = nlohmann::ordered_json::array();
    for (const Columns& each : columns_) {
      columns.push_back({{"segmenter", each.segmenter},
                         {"radius", each.radius},
                         {"range_stddev", each.range_stddev},
                         {"scans", each.scans},
                         {"false_corners_per_100_scans", each.false_per_100_scans()}});
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph("Corners from " + std::to_string(scans_) +
                   " scans of an empty room of 5 x 3.5 m at random places, 10 mm and 0.113 deg of "
                   "noise, by the number of rays and the share of them that return from somewhere "
                   "before the wall: all four corners are there to be found.");
    HtmlTable table{{},
                    {"segmenter", "strays [%]", "rays", "found [%]", "false per 100 scans",
                     "in the 95 % ellipse [%]", "NEES"},
                    {},
                    1};
    for (const Room& room : rooms_) {
      table.rows.push_back(
          {room.segmenter, fixed(100.0 * room.strays, 0), std::to_string(room.rays),
           interval_text(room.result.recall, 1, 100.0), fixed(room.result.false_per_100_scans(), 1),
           interval_text(room.result.coverage, 1, 100.0), fixed(room.result.nees.value, 2)});
    }
    page.table(table);
    page.paragraph(
        "Corners found per 100 scans of nothing but a column, its surface 0.5 to 10 m "
        "away: a round thing has none.");
    HtmlTable columns{{}, {"segmenter", "noise [mm]"}, {}, 1};
    for (const double radius : radii) columns.head.push_back(fixed(radius, 2) + " m");
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (k % radii.size() == 0) {
        columns.rows.push_back({columns_[k].segmenter, fixed(1e3 * columns_[k].range_stddev, 0)});
      }
      columns.rows.back().push_back(fixed(columns_[k].false_per_100_scans(), 2));
    }
    page.table(columns);
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"room of 5 x 3.5 m", "strays [%]", "corners found [%]",
                       "false per 100 scans", "coverage [%]"}};
    for (const Room& room : rooms_) {
      rows.push_back({std::to_string(room.rays) + " rays", fixed(100.0 * room.strays, 0),
                      fixed(100.0 * room.result.recall.value, 1),
                      fixed(room.result.false_per_100_scans(), 1),
                      fixed(100.0 * room.result.coverage.value, 1)});
    }
    std::size_t scans = 0;
    std::size_t corners = 0;
    double worst = 0.0;
    for (const Columns& columns : columns_) {
      scans += columns.scans;
      corners += columns.false_corners;
      worst = std::max(worst, columns.false_per_100_scans());
    }
    const double all =
        scans > 0 ? 100.0 * static_cast<double>(corners) / static_cast<double>(scans) : 0.0;
    rows.push_back({"columns, all", "", "", fixed(all, 2), ""});
    rows.push_back({"columns, worst", "", "", fixed(worst, 2), ""});
    return rows;
  }

 private:
  static Extraction extraction_of(const std::string& segmenter, const std::stop_token& stop) {
    return {stoppable(make_segmenter(segmenter), stop),
            make_fitter(Fitters::descriptions().front().name, "propagated"),
            CornerFinders::make<CornerFinder>(CornerFinders::descriptions().front().name, {})};
  }

  void judge(Columns& columns, const std::stop_token& stop) const {
    Extraction extraction = extraction_of(columns.segmenter, stop);
    for (const double distance : distances) {
      const CornerQuality quality =
          judge_column(extraction, columns.radius, distance,
                       {920, rplidar_noise(columns.range_stddev), 0.0, scans_,
                        derived_seed(seed_, "columns/" + fixed(distance, 1)), 0.0});
      columns.scans += quality.scans;
      columns.false_corners += quality.false_corners;
    }
  }

  std::size_t scans_;
  std::uint64_t seed_;
  std::vector<Room> rooms_;
  std::vector<Columns> columns_;
};

}  // namespace

std::unique_ptr<Section> make_robustness_section(const EvaluationSetup& setup) {
  return std::make_unique<RobustnessSection>(setup);
}

}  // namespace quoin::deploy
