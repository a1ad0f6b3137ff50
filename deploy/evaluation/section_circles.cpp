// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/circles/circle_fitters.hpp"
#include "core/evaluation/circle_consistency.hpp"
#include "core/evaluation/fit_timing.hpp"
#include "core/evaluation/papers/paper_corners.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::array radii{0.05, 0.1, 0.2, 0.5, 1.0};    // [m] of columns
constexpr std::array surfaces{0.5, 1.0, 2.0, 4.0, 8.0};  // [m] from the sensor
constexpr std::array room_radii{1.0, 3.0};               // [m]
constexpr std::array fields{360.0, 90.0, 40.0};          // [deg] of a room that is seen
constexpr double fewest_points = 5.0;                    // else there is nothing to judge
constexpr double enough_points = 12.0;                   // for the summary
constexpr double nearly_linear = 0.05;                   // nonlinearity
constexpr std::size_t timed_points = 100;

double expected_points(const ArcScene& scene) {
  const double angle =
      scene.concave() ? scene.field : 2.0 * std::asin(scene.radius / scene.distance);
  return angle * static_cast<double>(scene.rays) / (2.0 * pi);
}

std::vector<ArcScene> arc_scenes() {
  std::vector<ArcScene> scenes;
  for (const double radius : radii) {
    for (const double surface : surfaces) {
      const ArcScene scene{radius, radius + surface};
      if (expected_points(scene) >= fewest_points) scenes.push_back(scene);
    }
  }
  for (const double radius : room_radii) {
    for (const double field : fields) scenes.push_back({radius, radius / 3.0, field / degrees});
  }
  return scenes;
}

std::string text_of(const SensorModel& noise) {
  std::string text = noise_text(noise);
  if (noise.range_stddev_per_metre > 0.0) {
    text += ", " + fixed(1e3 * noise.range_stddev_per_metre, 0) + " mm/m";
  }
  return text;
}

std::string text_of(const ArcScene& scene) {
  const std::string radius = fixed(scene.radius, 2) + " m";
  if (!scene.concave()) {
    return "column of " + radius + " at " + fixed(scene.distance - scene.radius, 1) + " m";
  }
  return "room of " + radius + ", " + fixed(scene.field * degrees, 0) + " deg of it";
}

std::vector<SensorModel> arc_noises() {
  SensorModel growing = rplidar_noise(0.010);
  growing.range_stddev_per_metre = 0.005;
  return {rplidar_noise(0.003), rplidar_noise(0.010), growing, data_sheet_model()};
}

nlohmann::ordered_json failures_of(const CircleFailureCounts& failures) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& [failure, name] : EnumNames<CircleFailure>::names) {
    const std::size_t count = failures[static_cast<std::size_t>(failure)];
    if (failure != CircleFailure::none && count > 0) object[std::string(name)] = count;
  }
  return object;
}

struct ArcEntry {
  std::string fitter;
  ArcScene scene;
  SensorModel noise;
  CircleConsistency result;

  [[nodiscard]] std::size_t found() const { return result.failures[0]; }
  [[nodiscard]] bool judged() const {
    return result.points >= enough_points && found() == result.trials;
  }
};

/// The range of a figure over several cells.
struct Extremes {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  [[nodiscard]] std::string text(int digits, double factor = 1.0) const {
    if (least > most) return "-";
    return fixed(factor * least, digits) + " to " + fixed(factor * most, digits);
  }
};

class CirclesSection : public Section {
 public:
  explicit CirclesSection(const EvaluationSetup& setup)
      : trials_(setup.options.trials), seed_(setup.options.seed), noises_(arc_noises()) {
    for (const MethodInfo& method : CircleFitters::descriptions()) {
      times_.emplace_back(method.name, std::nullopt);
      for (const SensorModel& noise : noises_) {
        for (const ArcScene& scene : arc_scenes()) {
          entries_.push_back({method.name, scene, noise, {}});
        }
      }
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (ArcEntry& entry : entries_) {
      jobs.push_back(
          {entry.fitter + " of a " + text_of(entry.scene), [this, &entry](const auto& stop) {
             const auto fitter = CircleFitters::make<CircleFitter>(entry.fitter, {});
             // All fitters are given the same measurements.
             const std::uint64_t seed = derived_seed(
                 seed_, "circles/" + text_of(entry.scene) + "/" + text_of(entry.noise));
             entry.result = judge_circle_consistency(
                 [&](const PointsView& points, const SensorModel& sensor) {
                   if (stop.stop_requested()) throw Interrupted();
                   return fitter(points, sensor);
                 },
                 entry.scene, entry.noise, trials_, seed);
           }});
    }
    return jobs;
  }

  std::vector<Job> timing_jobs() override {
    std::vector<Job> jobs{{"speed of a plain covariance", [this](const auto&) {
                             covariance_time_ =
                                 seconds_per_plain_covariance(timing_columns(timed_points));
                           }}};
    for (auto& [name, seconds] : times_) {
      jobs.push_back(
          {"speed of " + name + " circles", [&name = name, &seconds = seconds](const auto&) {
             seconds = seconds_per_fit(CircleFitters::make<CircleFitter>(name, {}),
                                       timing_columns(timed_points));
           }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& section = report["circles"];
    auto& cells = section["cells"] = nlohmann::ordered_json::array();
    for (const ArcEntry& entry : entries_) {
      const CircleConsistency& result = entry.result;
      nlohmann::ordered_json object{{"name", entry.fitter},
                                    {"radius", entry.scene.radius},
                                    {"distance", entry.scene.distance},
                                    {"field", entry.scene.field},
                                    {"range_stddev", entry.noise.range_stddev},
                                    {"range_stddev_per_metre", entry.noise.range_stddev_per_metre},
                                    {"bearing_stddev", entry.noise.bearing_stddev},
                                    {"trials", result.trials},
                                    {"found", entry.found()},
                                    {"points", result.points},
                                    {"nonlinearity", result.nonlinearity}};
      if (entry.found() > 0) {
        add_interval(object, "nees", result.nees);
        add_interval(object, "coverage95", result.coverage95);
        add_interval(object, "coverage95_center", result.coverage95_center);
        add_interval(object, "rmse_over_crb", result.rmse_over_crb);
        add_interval(object, "radius_rmse_over_crb", result.radius_rmse_over_crb);
      }
      object["failures"] = failures_of(result.failures);
      cells.push_back(std::move(object));
    }
    auto& times = section["fit_times"] = nlohmann::ordered_json::array();
    for (const auto& [name, seconds] : times_) {
      nlohmann::ordered_json object{{"name", name},
                                    {"points", timed_points},
                                    {"seconds", nullptr},
                                    {"over_covariance", nullptr}};
      if (seconds) object["seconds"] = *seconds;
      if (seconds && covariance_time_) object["over_covariance"] = *seconds / *covariance_time_;
      times.push_back(std::move(object));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "Monte Carlo with the true arcs, 920 rays a revolution, " + std::to_string(trials_) +
        " trials each: the near side of a column, or what is seen of a round room from a third of "
        "its radius off the centre. A covariance that is right has a NEES of 3, and 95 % of the "
        "circles in the ellipsoid of centre and radius, and of the centres in their ellipse. "
        "Nonlinearity is the larger of the standard deviation of the radius (at the Cramer-Rao "
        "bound) and of a point along the circle, over the radius: only where it is small are the "
        "errors Gaussian. Fits that find the circle not determined are counted as failures, and "
        "the figures are of the others.");
    for (const SensorModel& noise : noises_) {
      for (const auto& [name, unused] : times_) {
        page.heading(3, name + ", noise " + text_of(noise));
        page.table(cells_of(name, noise));
      }
    }
    if (!covariance_time_) return;
    page.heading(3, "Time of a circle");
    HtmlTable table{{}, {"fitter", "time [us]", "over plain covariance"}, {}, 1, true};
    for (const auto& [name, seconds] : times_) {
      table.rows.push_back({name, seconds ? fixed(1e6 * *seconds, 3) : "-",
                            seconds ? fixed(*seconds / *covariance_time_, 1) : "-"});
    }
    table.rows.push_back({"plain covariance", fixed(1e6 * *covariance_time_, 3), "1.0"});
    page.table(table);
  }

  SummaryTable summary() const override {
    SummaryTable rows{
        {"arcs of 12 points and more", "cells", "coverage [%]", "of the centre [%]", "RMSE/CRB"}};
    for (const auto& [name, unused] : times_) {
      for (const bool linear : {true, false}) {
        std::size_t cells = 0;
        Extremes coverage;
        Extremes center;
        Extremes error;
        for (const ArcEntry& entry : entries_) {
          if (entry.fitter != name || !entry.judged()) continue;
          if ((entry.result.nonlinearity < nearly_linear) != linear) continue;
          ++cells;
          coverage.add(entry.result.coverage95.value);
          center.add(entry.result.coverage95_center.value);
          error.add(entry.result.rmse_over_crb.value);
        }
        rows.push_back({name + (linear ? ", nonlinearity < 0.05" : ", more"), std::to_string(cells),
                        coverage.text(1, 100.0), center.text(1, 100.0), error.text(3)});
      }
    }
    return rows;
  }

 private:
  [[nodiscard]] HtmlTable cells_of(const std::string& fitter, const SensorModel& noise) const {
    HtmlTable table{{},
                    {"arc", "points", "nonlinearity", "failures [%]", "NEES", "coverage [%]",
                     "of the centre [%]", "RMSE/CRB", "radius RMSE/CRB"},
                    {},
                    1};
    for (const ArcEntry& entry : entries_) {
      if (entry.fitter != fitter || text_of(entry.noise) != text_of(noise)) continue;
      const CircleConsistency& result = entry.result;
      const double failed =
          1.0 - static_cast<double>(entry.found()) / static_cast<double>(result.trials);
      std::vector<std::string> row{text_of(entry.scene), fixed(result.points, 0),
                                   fixed(result.nonlinearity, 3), fixed(100.0 * failed, 1)};
      if (entry.found() > 0) {
        row.insert(row.end(),
                   {interval_text(result.nees, 2), interval_text(result.coverage95, 1, 100.0),
                    interval_text(result.coverage95_center, 1, 100.0),
                    interval_text(result.rmse_over_crb, 3),
                    interval_text(result.radius_rmse_over_crb, 3)});
      } else {
        row.insert(row.end(), 5, "-");
      }
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  std::size_t trials_;
  std::uint64_t seed_;
  std::vector<SensorModel> noises_;
  std::vector<ArcEntry> entries_;
  std::vector<std::pair<std::string, std::optional<double>>> times_;  // [s]
  std::optional<double> covariance_time_;                             // [s]
};

}  // namespace

std::unique_ptr<Section> make_circles_section(const EvaluationSetup& setup) {
  return std::make_unique<CirclesSection>(setup);
}

}  // namespace quoin::deploy
