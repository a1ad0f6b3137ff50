// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/evaluation/consistency.hpp"
#include "core/evaluation/fit_timing.hpp"
#include "core/evaluation/papers/wctls_paper.hpp"
#include "core/extraction/extraction.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t timed_points = 100;  // of a wall whose fit is timed

struct Entry {
  std::string fitter;
  std::string covariance;
  std::size_t world = 0;
  SensorModel noise;
  Consistency result;

  [[nodiscard]] bool has_corners() const { return !result.corners.empty(); }
};

struct FitTime {
  std::string name;
  std::optional<double> seconds;
};

class ConsistencySection : public Section {
 public:
  explicit ConsistencySection(const EvaluationSetup& setup)
      : trials_(setup.options.trials),
        seed_(setup.options.seed),
        worlds_(worlds_or(setup, {"environment_a", "environment_b"})),
        noises_{data_sheet_model(), rplidar_noise(0.010)},
        covariance_time_{"plain_covariance", std::nullopt} {
    for (const std::string& fitter : setup.fitters) fit_times_.push_back({fitter, std::nullopt});
    for (const SensorModel& noise : noises_) {
      for (std::size_t world = 0; world < worlds_.size(); ++world) {
        for (const std::string& fitter : setup.fitters) {
          for (const std::string& covariance : covariance_modes(fitter)) {
            entries_.push_back({fitter, covariance, world, noise, {}});
          }
        }
      }
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (Entry& entry : entries_) {
      const World& world = worlds_[entry.world];
      jobs.push_back({entry.fitter + " in " + world.name, [this, &entry, &world](const auto& stop) {
                        const Scene scene =
                            observe(world, world.pose_at(0.0), rays_per_revolution(world.name));
                        const Fitter fitter =
                            stoppable(make_fitter(entry.fitter, entry.covariance), stop);
                        // All fitters and modes are given the same measurements.
                        const std::uint64_t seed = derived_seed(
                            seed_, "consistency/" + world.name + "/" + noise_text(entry.noise));
                        entry.result = judge_consistency(fitter, scene, entry.noise, trials_, seed);
                      }});
    }
    return jobs;
  }

  std::vector<Job> timing_jobs() override {
    std::vector<Job> jobs{{"speed of a plain covariance", [this](const auto&) {
                             covariance_time_.seconds =
                                 seconds_per_plain_covariance(timing_walls(timed_points));
                           }}};
    for (FitTime& time : fit_times_) {
      jobs.push_back({"speed of " + time.name, [&time](const auto&) {
                        // Not stoppable, which costs time itself; it takes milliseconds.
                        time.seconds =
                            seconds_per_fit(make_fitter(time.name, ""), timing_walls(timed_points));
                      }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& array = report["fitters"] = nlohmann::ordered_json::array();
    for (const Entry& entry : entries_) {
      nlohmann::ordered_json object{{"name", entry.fitter},
                                    {"covariance", entry.covariance},
                                    {"environment", worlds_[entry.world].name},
                                    {"range_stddev", entry.noise.range_stddev},
                                    {"bearing_stddev", entry.noise.bearing_stddev},
                                    {"trials", entry.result.trials},
                                    {"corners", entry.result.corners.size()}};
      if (entry.has_corners()) {
        add_interval(object, "nees", entry.result.nees);
        add_interval(object, "coverage95", entry.result.coverage95);
        add_interval(object, "rmse_over_crb", entry.result.rmse_over_crb_interval);
        object["worst_corner"] = entry.result.worst_corner;
      } else {
        for (const char* name : {"nees", "coverage95", "rmse_over_crb", "worst_corner"}) {
          object[name] = nullptr;
        }
      }
      object["failures"] = failures_json(entry.result.failures);
      array.push_back(std::move(object));
    }
    auto& times = report["fit_times"] = nlohmann::ordered_json::array();
    for (const FitTime& time : fit_times_) times.push_back(time_json(time));
    times.push_back(time_json(covariance_time_));
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "Monte Carlo with the true segmentation: every trial measures all walls in sight anew, "
        "each fitter gets the same measurements, and the corners of neighbouring lines are held "
        "against the true ones. A covariance that is right has a NEES (mean squared Mahalanobis "
        "distance) of 2 and 95 % of the corners in their 95 % ellipses. RMSE/CRB is the root mean "
        "squared error over the smallest an unbiased fit can have (Cramer-Rao bound), median over "
        "the corners; it does not depend on the covariance. " +
        std::to_string(trials_) + " trials each; intervals are 95 % confidence.");
    for (const SensorModel& noise : noises_) {
      for (std::size_t world = 0; world < worlds_.size(); ++world) {
        page.heading(3, worlds_[world].name + ", noise " + noise_text(noise));
        write_group(page, noise, world);
      }
    }
    if (covariance_time_.seconds) write_times(page);
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"coverage [%]", "covariance"}};
    for (const SensorModel& noise : noises_) {
      for (const World& world : worlds_) {
        rows[0].push_back(world.name + ", " + fixed(1e3 * noise.range_stddev, 0) + " mm");
      }
    }
    // The entries run through the methods once for each column.
    const std::size_t columns = noises_.size() * worlds_.size();
    const std::size_t methods = columns == 0 ? 0 : entries_.size() / columns;
    for (std::size_t k = 0; k < methods; ++k) {
      rows.push_back({entries_[k].fitter, entries_[k].covariance});
      for (std::size_t column = 0; column < columns; ++column) {
        const Entry& entry = entries_[column * methods + k];
        rows.back().push_back(entry.has_corners() ? fixed(100.0 * entry.result.coverage95.value, 1)
                                                  : "-");
      }
    }
    return rows;
  }

 private:
  /// Nothing before both have been measured.
  [[nodiscard]] std::optional<double> over_covariance(const FitTime& time) const {
    if (!time.seconds || !covariance_time_.seconds) return std::nullopt;
    return *time.seconds / *covariance_time_.seconds;
  }

  [[nodiscard]] nlohmann::ordered_json time_json(const FitTime& time) const {
    nlohmann::ordered_json object{{"name", time.name},
                                  {"points", timed_points},
                                  {"seconds", nullptr},
                                  {"over_covariance", nullptr}};
    if (time.seconds) object["seconds"] = *time.seconds;
    if (const auto ratio = over_covariance(time)) object["over_covariance"] = *ratio;
    return object;
  }

  void write_times(HtmlPage& page) const {
    page.heading(3, "Time of a fit");
    page.paragraph("One line with its covariance from " + std::to_string(timed_points) +
                   " points, on one processor; beside it the plain covariance of x and y of the "
                   "same points with Eigen, which is the least that any fit has to do.");
    HtmlTable table{{}, {"fitter", "time [us]", "over plain covariance"}, {}, 1, true};
    const auto add = [&](const FitTime& time) {
      const std::optional<double> ratio = over_covariance(time);
      table.rows.push_back({time.name, time.seconds ? fixed(1e6 * *time.seconds, 3) : "-",
                            ratio ? fixed(*ratio, 1) : "-"});
    };
    for (const FitTime& time : fit_times_) add(time);
    add(covariance_time_);
    page.table(table);
  }

  void write_group(HtmlPage& page, const SensorModel& noise, std::size_t world) const {
    const std::string where = worlds_[world].name + ", " + noise_text(noise);
    IntervalChart coverage = coverage_chart(where);
    IntervalChart efficiency;
    efficiency.title = "RMSE over Cramer-Rao bound, " + where;
    efficiency.x.title = "RMSE/CRB";
    efficiency.series.resize(1);
    efficiency.series.front().name = "RMSE/CRB";
    efficiency.reference = 1.0;
    efficiency.reference_name = "bound";
    HtmlTable table{{},
                    {"fitter", "covariance", "NEES", "coverage [%]", "RMSE/CRB",
                     "worst corner [standard errors]", "failures"},
                    {},
                    2};
    for (const Entry& entry : entries_) {
      if (entry.world != world || entry.noise.range_stddev != noise.range_stddev) continue;
      const Consistency& result = entry.result;
      if (!entry.has_corners()) {
        table.rows.push_back(
            {entry.fitter, entry.covariance, "-", "-", "-", "-", failures_text(result.failures)});
        continue;
      }
      table.rows.push_back({entry.fitter, entry.covariance, interval_text(result.nees, 2),
                            interval_text(result.coverage95, 1, 100.0),
                            interval_text(result.rmse_over_crb_interval, 3),
                            fixed(result.worst_corner, 1), failures_text(result.failures)});
      const bool new_fitter =
          coverage.categories.empty() || coverage.categories.back() != entry.fitter;
      if (new_fitter) {
        coverage.categories.push_back(entry.fitter);
        efficiency.categories.push_back(entry.fitter);
        efficiency.series.front().values.emplace_back(plotted(result.rmse_over_crb_interval));
      }
      auto series = std::find_if(coverage.series.begin(), coverage.series.end(),
                                 [&](const auto& s) { return s.name == entry.covariance; });
      if (series == coverage.series.end()) {
        series = coverage.series.insert(series, {entry.covariance, {}});
      }
      series->values.resize(coverage.categories.size());
      series->values.back() = plotted(result.coverage95, 100.0);
    }
    page.figure(plot_svg(coverage), "Points with 95 % confidence intervals over the trials.");
    page.figure(plot_svg(efficiency), "1 is the least an unbiased fit can have.");
    page.table(table);
  }

  std::size_t trials_;
  std::uint64_t seed_;
  std::vector<World> worlds_;
  std::vector<SensorModel> noises_;
  std::vector<Entry> entries_;
  std::vector<FitTime> fit_times_;
  FitTime covariance_time_;  // of the plain covariance
};

}  // namespace

std::unique_ptr<Section> make_consistency_section(const EvaluationSetup& setup) {
  return std::make_unique<ConsistencySection>(setup);
}

}  // namespace quoin::deploy
