// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/localization_scenarios.hpp"
#include "core/evaluation/mapping_quality.hpp"
#include "core/mapping/localizers.hpp"
#include "core/statistics/order_statistics.hpp"
#include "deploy/evaluation/drawing/drawing.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/pose_relations.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr double same_stamp = 1e-3;    // [s] of a relation and a scan
constexpr double largest_gap = 2.0;    // [s] that a trajectory is interpolated over
constexpr double largest_lever = 1.0;  // [m] from the robot to its LiDAR

double processor_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// How a localizer is fed on a simulated drive.
struct Variant {
  const char* method;
  const char* fitter;
  const char* covariance;
  bool odometry;
};
constexpr Variant variants[] = {{"landmarks", "inverse_range", "propagated", true},
                                {"landmarks", "wctls", "as_published", true},
                                {"landmarks", "inverse_range", "propagated", false},
                                {"angular_offsets", "inverse_range", "propagated", true}};

struct DriveEntry {
  std::size_t world = 0;
  Variant variant;
  MappingQuality quality;
};

/// A recorded log, localized by the LiDAR and what odometry it has.
struct LogEntry {
  std::size_t file = 0;
  bool has_odometry = false;
  std::size_t scans = 0, tracking = 0, ambiguous = 0, lost = 0;
  RelationErrors at_scans;      // relations whose stamps are those of scans
  RelationErrors interpolated;  // all that the trajectory covers
  RelationErrors own;           // interpolated, of the poses that the log holds
  double median_seconds = 0.0, p99_seconds = 0.0, longest_seconds = 0.0;
  Drawing picture;
};

struct ScenarioEntry {
  ScenarioRun run;
  ScenarioOutcome outcome;
};

/// What the runs of one scenario came to.
struct ScenarioSum {
  std::size_t runs = 0, wrong_runs = 0, scans = 0, tracking = 0, ambiguous = 0, lost = 0;
  std::size_t lost_runs = 0, found_runs = 0;
  double largest_tracked = 0.0, slowest_lost = 0.0, slowest_found = 0.0;  // [m], [s], [s]

  void add(const ScenarioOutcome& outcome) {
    ++runs;
    wrong_runs += outcome.confident_wrong > 0 ? 1 : 0;
    scans += outcome.scans;
    tracking += outcome.tracking;
    ambiguous += outcome.ambiguous;
    lost += outcome.lost;
    lost_runs += outcome.lost_after ? 1 : 0;
    found_runs += outcome.found_after ? 1 : 0;
    largest_tracked = std::max(largest_tracked, outcome.largest_tracked);
    slowest_lost = std::max(slowest_lost, outcome.lost_after.value_or(0.0));
    slowest_found = std::max(slowest_found, outcome.found_after.value_or(0.0));
  }
  [[nodiscard]] double percent(std::size_t of) const {
    return 100.0 * static_cast<double>(of) / static_cast<double>(std::max<std::size_t>(scans, 1));
  }
};

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// Poses of a log whose odometry is that of its poses were corrected by a mapper, both of them.
bool has_raw_odometry(const ScanFile& file) {
  return std::any_of(file.scans.begin(), file.scans.end(), [](const auto& scan) {
    if (scan.odometry.empty()) return false;
    if (!scan.pose) return true;
    const Pose2 apart = between(*scan.pose, scan.odometry.back().pose);
    return std::hypot(apart.x, apart.y) > largest_lever;
  });
}

class MappingSection : public Section {
 public:
  explicit MappingSection(const EvaluationSetup& setup)
      : seed_(setup.options.seed),
        timing_(setup.options.timing),
        laps_(setup.options.laps),
        worlds_(worlds_or(setup, world_names())),
        files_(setup.scan_files),
        noise_(setup.options.scan_noise),
        relations_(setup.relations) {
    for (std::size_t world = 0; world < worlds_.size(); ++world) {
      for (const Variant& variant : variants) drives_.push_back({world, variant, {}});
    }
    for (const auto& [scenario, name] : EnumNames<LocalizationScenario>::names) {
      for (std::size_t i = 0; i < setup.options.scenarios; ++i) {
        // Every other robot has no wheel odometry.
        const std::uint64_t seed =
            derived_seed(seed_, "scenario/" + std::string(name) + "/" + std::to_string(i));
        scenarios_.push_back({{scenario, seed, i % 2 == 0}, {}});
      }
    }
    for (std::size_t file = 0; file < files_.size(); ++file) {
      const auto& scans = files_[file].scans;
      if (scans.size() > 1 && scans.front().stamp) logs_.emplace_back().file = file;
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (DriveEntry& entry : drives_) {
      jobs.push_back({std::string(entry.variant.method) + " in " + worlds_[entry.world].name,
                      [this, &entry](const auto& stop) { drive(entry, stop); }});
    }
    for (ScenarioEntry& entry : scenarios_) {
      jobs.push_back({"scenario " + std::string(enum_name(entry.run.scenario)),
                      [this, &entry](const auto& stop) { play(entry, stop); }});
    }
    for (LogEntry& entry : logs_) {
      jobs.push_back({"landmarks on " + files_[entry.file].name,
                      [this, &entry](const auto& stop) { localize(entry, stop); }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto& object = report["mapping"] = nlohmann::ordered_json::object();
    object["laps"] = laps_;
    auto& drives = object["simulated"] = nlohmann::ordered_json::array();
    for (const DriveEntry& entry : drives_) {
      const MappingQuality& q = entry.quality;
      drives.push_back({{"environment", worlds_[entry.world].name},
                        {"method", entry.variant.method},
                        {"fitter", entry.variant.fitter},
                        {"covariance", entry.variant.covariance},
                        {"odometry", entry.variant.odometry},
                        {"scans", q.scans},
                        {"translation_median", median(q.translation_errors)},
                        {"translation_max", quantile(q.translation_errors, 1.0)},
                        {"heading_first_tenth", tenth(q.heading_errors, false)},
                        {"heading_last_tenth", tenth(q.heading_errors, true)},
                        {"nees", q.mean_nees()},
                        {"inside95", q.coverage95()},
                        {"tracking", q.tracking},
                        {"ambiguous", q.ambiguous},
                        {"lost", q.lost},
                        {"confident_wrong", q.confident_wrong},
                        {"map_lines", q.map_lines},
                        {"map_precision", q.map_precision},
                        {"map_recall", q.map_recall}});
    }
    auto& scenarios = object["scenarios"] = nlohmann::ordered_json::array();
    for (const ScenarioEntry& entry : scenarios_) {
      const ScenarioOutcome& o = entry.outcome;
      nlohmann::ordered_json scenario{{"scenario", std::string(enum_name(entry.run.scenario))},
                                      {"seed", entry.run.seed},
                                      {"odometry", entry.run.odometry},
                                      {"scans", o.scans},
                                      {"tracking", o.tracking},
                                      {"ambiguous", o.ambiguous},
                                      {"lost", o.lost},
                                      {"confident_wrong", o.confident_wrong},
                                      {"largest_tracked", o.largest_tracked}};
      if (o.lost_after) scenario["lost_after"] = *o.lost_after;
      if (o.found_after) scenario["found_after"] = *o.found_after;
      scenarios.push_back(std::move(scenario));
    }
    auto& logs = object["logs"] = nlohmann::ordered_json::array();
    for (const LogEntry& entry : logs_) {
      nlohmann::ordered_json log{{"file", files_[entry.file].name},
                                 {"odometry", entry.has_odometry},
                                 {"scans", entry.scans},
                                 {"tracking", entry.tracking},
                                 {"ambiguous", entry.ambiguous},
                                 {"lost", entry.lost}};
      add_errors(log, "at_scans", entry.at_scans);
      add_errors(log, "interpolated", entry.interpolated);
      add_errors(log, "poses_of_the_log", entry.own);
      if (timing_) {
        log["median_ms"] = 1e3 * entry.median_seconds;
        log["p99_ms"] = 1e3 * entry.p99_seconds;
        log["longest_ms"] = 1e3 * entry.longest_seconds;
      }
      logs.push_back(std::move(log));
    }
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "Simulated drives of " + fixed(laps_, 1) +
        " laps with 10 mm of noise and wheels that slip "
        "by 2 %, judged by the truth. NEES is 3 on average when the covariance of (x, y, heading) "
        "is true. Wrong is a pose beyond four sigma while the status is tracking. The map counts "
        "as right within 5 cm and 3 deg of a wall.");
    HtmlTable table{{},
                    {"environment", "method", "covariances", "odometry", "median error [mm]",
                     "largest [mm]", "heading, first tenth [deg]", "last tenth [deg]", "NEES",
                     "in 95 % [%]", "tracking [%]", "wrong", "map precision [%]", "recall [%]"},
                    {},
                    4};
    for (const DriveEntry& entry : drives_) {
      const MappingQuality& q = entry.quality;
      table.rows.push_back(
          {worlds_[entry.world].name, entry.variant.method,
           std::string(entry.variant.fitter) + ", " + entry.variant.covariance,
           entry.variant.odometry ? "yes" : "no", fixed(1e3 * median(q.translation_errors), 1),
           fixed(1e3 * quantile(q.translation_errors, 1.0), 1),
           fixed(degrees * tenth(q.heading_errors, false), 3),
           fixed(degrees * tenth(q.heading_errors, true), 3), fixed(q.mean_nees(), 2),
           fixed(100.0 * q.coverage95(), 1),
           fixed(100.0 * static_cast<double>(q.tracking) / static_cast<double>(q.scans), 1),
           std::to_string(q.confident_wrong), fixed(100.0 * q.map_precision, 1),
           fixed(100.0 * q.map_recall, 1)});
    }
    page.table(table);
    write_scenarios(page);
    if (logs_.empty()) return;
    page.heading(3, "Recorded logs");
    page.paragraph(
        "Relations between poses that people verified (Kuemmerle et al. 2009): mean and standard "
        "deviation of the length by which the relative translation differs, and of the rotation. "
        "Relations at scans are those with both stamps within 1 ms of one; a stamp that is some "
        "milliseconds off is that of another scan. Poses of a log are a particle filter's.");
    HtmlTable logs{{},
                   {"log", "odometry", "scans", "tracking [%]", "relations", "at scans [m]",
                    "interpolated [m]", "rotation [deg]", "poses of the log [m]", "median [ms]",
                    "p99 [ms]", "longest [ms]"},
                   {},
                   2};
    for (const LogEntry& entry : logs_) {
      logs.rows.push_back(
          {files_[entry.file].name, entry.has_odometry ? "yes" : "no", std::to_string(entry.scans),
           fixed(100.0 * static_cast<double>(entry.tracking) /
                     static_cast<double>(std::max<std::size_t>(entry.scans, 1)),
                 1),
           std::to_string(entry.at_scans.translation.size()) + " / " +
               std::to_string(entry.interpolated.translation.size()),
           spread(entry.at_scans.translation), spread(entry.interpolated.translation),
           fixed(degrees * mean(entry.interpolated.rotation), 2), spread(entry.own.translation),
           timing_ ? fixed(1e3 * entry.median_seconds, 1) : "-",
           timing_ ? fixed(1e3 * entry.p99_seconds, 1) : "-",
           timing_ ? fixed(1e3 * entry.longest_seconds, 1) : "-"});
    }
    page.table(logs);
    page.paragraph(
        "Published on the whole raw logs, which are not to be had any more: Freiburg 079 scan "
        "matching 0.258 +- 0.427 m, particle filter 0.061 +- 0.044 m, graph mapping 0.056 +- 0.042 "
        "m; Intel 0.220 +- 0.296 m, 0.070 +- 0.083 m, 0.031 +- 0.026 m (Kuemmerle et al. 2009).");
    for (const LogEntry& entry : logs_) {
      page.figure(draw_svg(entry.picture), "Mapped walls, and the way of the sensor (points).");
    }
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"median error [mm] / NEES", "covariances", "odometry"}};
    for (const World& world : worlds_) rows[0].push_back(world.name);
    for (const Variant& variant : variants) {
      rows.push_back({variant.method, std::string(variant.fitter) + " " + variant.covariance,
                      variant.odometry ? "yes" : "no"});
      for (const DriveEntry& entry : drives_) {
        if (entry.variant.method != variant.method || entry.variant.fitter != variant.fitter ||
            entry.variant.odometry != variant.odometry) {
          continue;
        }
        rows.back().push_back(fixed(1e3 * median(entry.quality.translation_errors), 1) + " / " +
                              fixed(entry.quality.mean_nees(), 2));
      }
    }
    std::size_t wrong = 0;
    for (const ScenarioEntry& entry : scenarios_) {
      wrong += entry.outcome.confident_wrong > 0 ? 1 : 0;
    }
    if (!scenarios_.empty()) {
      rows.push_back({"wrong runs of scenarios",
                      std::to_string(wrong) + " of " + std::to_string(scenarios_.size()), ""});
    }
    for (const LogEntry& entry : logs_) {
      rows.push_back({files_[entry.file].name + " [m]",
                      spread(entry.at_scans.translation) + ", " +
                          std::to_string(entry.at_scans.translation.size()) + " relations at scans",
                      entry.has_odometry ? "yes" : "no"});
    }
    for (auto& row : rows) row.resize(rows.front().size());
    return rows;
  }

 private:
  [[nodiscard]] ScenarioSum sum_of(LocalizationScenario scenario) const {
    ScenarioSum sum;
    for (const ScenarioEntry& entry : scenarios_) {
      if (entry.run.scenario == scenario) sum.add(entry.outcome);
    }
    return sum;
  }

  void write_scenarios(HtmlPage& page) const {
    if (scenarios_.empty()) return;
    page.heading(3, "What makes robots believe in a wrong pose");
    page.paragraph(
        "Runs of a minute with landmarks, every other one without wheel odometry. A run is wrong "
        "when one of its poses is beyond four sigma while the status is tracking. Lost and found "
        "again: of robots that are carried away or blinded after 25 s; times are of the slowest.");
    HtmlTable table{
        {},
        {"scenario", "runs", "wrong runs", "tracking [%]", "ambiguous [%]", "lost [%]",
         "largest error tracked [mm]", "lost runs", "after [s]", "found runs", "after [s]"},
        {},
        1};
    for (const auto& [scenario, name] : EnumNames<LocalizationScenario>::names) {
      const ScenarioSum sum = sum_of(scenario);
      table.rows.push_back({std::string(name), std::to_string(sum.runs),
                            std::to_string(sum.wrong_runs), fixed(sum.percent(sum.tracking), 1),
                            fixed(sum.percent(sum.ambiguous), 1), fixed(sum.percent(sum.lost), 1),
                            fixed(1e3 * sum.largest_tracked, 1), std::to_string(sum.lost_runs),
                            fixed(sum.slowest_lost, 1), std::to_string(sum.found_runs),
                            fixed(sum.slowest_found, 1)});
    }
    page.table(table);
  }

  static double tenth(const std::vector<double>& values, bool last) {
    const auto count = static_cast<std::ptrdiff_t>(std::max<std::size_t>(values.size() / 10, 1));
    if (values.empty()) return 0.0;
    return last ? median({values.end() - count, values.end()})
                : median({values.begin(), values.begin() + count});
  }

  static std::string spread(const std::vector<double>& values) {
    if (values.empty()) return "-";
    const double center = mean(values);
    double squares = 0.0;
    for (const double value : values) squares += (value - center) * (value - center);
    return fixed(center, 3) + " +- " +
           fixed(std::sqrt(squares / static_cast<double>(values.size())), 3);
  }

  static void add_errors(nlohmann::ordered_json& object, const char* name,
                         const RelationErrors& errors) {
    if (errors.translation.empty()) {
      object[name] = nullptr;
      return;
    }
    object[name] = {{"relations", errors.translation.size()},
                    {"translation_mean", mean(errors.translation)},
                    {"translation_median", median(errors.translation)},
                    {"translation_max", quantile(errors.translation, 1.0)},
                    {"rotation_mean", mean(errors.rotation)}};
  }

  [[nodiscard]] static Extraction extraction_with(const std::string& fitter,
                                                  const std::string& covariance,
                                                  const std::stop_token& stop) {
    return {stoppable(make_segmenter("iepf"), stop), make_fitter(fitter, covariance),
            CornerFinders::make<CornerFinder>(CornerFinders::descriptions().front().name, {})};
  }

  void drive(DriveEntry& entry, const std::stop_token& stop) const {
    const World& world = worlds_[entry.world];
    Extraction extraction = extraction_with(entry.variant.fitter, entry.variant.covariance, stop);
    Localizer localizer = Localizers::make<Localizer>(entry.variant.method, {});
    SimulatedDrive drive;
    drive.laps = laps_;
    drive.heading_bias = 0.002;
    drive.odometry = entry.variant.odometry;
    drive.seed = derived_seed(seed_, "mapping/" + world.name);
    entry.quality = judge_localizer(std::ref(localizer), extraction, world, drive);
  }

  void play(ScenarioEntry& entry, const std::stop_token& stop) const {
    Extraction extraction = extraction_with("inverse_range", "propagated", stop);
    Localizer localizer = Localizers::make<Localizer>("landmarks", {});
    entry.outcome = run_scenario(entry.run, std::ref(localizer), extraction);
  }

  void localize(LogEntry& entry, const std::stop_token& stop) const {
    const ScanFile& file = files_[entry.file];
    Extraction extraction = extraction_with("inverse_range", "propagated", stop);
    Localizer localizer = Localizers::make<Localizer>("landmarks", {});
    entry.has_odometry = has_raw_odometry(file);
    Localization result;
    std::vector<std::pair<std::size_t, Pose2>> hung;
    std::vector<StampedPose> trajectory, own;
    std::vector<double> seconds;
    std::vector<Eigen::Vector2d> points;
    std::optional<Pose2> before;
    for (const sensor_bridge::RecordedScan& scan : file.scans) {
      // Clocks of recordings overflow, and recorders write a scan twice.
      if (!scan.stamp || (!trajectory.empty() && *scan.stamp <= trajectory.back().stamp)) continue;
      extraction.run({scan.bearings, scan.ranges, 0.05F, 30.0F}, noise_, noise_);
      points.clear();
      for (std::size_t i = 0; i < extraction.points().size(); ++i) {
        points.emplace_back(extraction.points().x[i], extraction.points().y[i]);
      }
      LocalizationInput input;
      input.stamp = *scan.stamp;
      input.lines = extraction.lines();
      input.corners = extraction.corners();
      input.points = points;
      input.wants_map = &scan == &file.scans.back();
      // That of the scan is the last one before it.
      std::optional<Pose2> now;
      if (entry.has_odometry && !scan.odometry.empty()) now = scan.odometry.back().pose;
      if (before && now) {
        const Pose2 increment = between(*before, *now);
        input.motion = PoseEstimate{increment, OdometryNoise{}.covariance(increment)};
      }
      before = now;
      const double start = processor_seconds();
      localizer(input, result);
      seconds.push_back(processor_seconds() - start);
      ++entry.scans;
      entry.tracking += result.status == LocalizationStatus::tracking ? 1 : 0;
      entry.ambiguous += result.status == LocalizationStatus::ambiguous ? 1 : 0;
      entry.lost += result.status == LocalizationStatus::lost ? 1 : 0;
      hung.emplace_back(result.keyframe.value_or(0), result.in_keyframe);
      trajectory.push_back({*scan.stamp, {}});
      if (scan.pose) own.push_back({*scan.stamp, *scan.pose});
    }
    const std::vector<Pose2> keyframes = localizer.keyframes();
    for (std::size_t i = 0; i < hung.size(); ++i) {
      trajectory[i].pose = compose(keyframes[hung[i].first], hung[i].second);
    }
    entry.at_scans = relation_errors(trajectory, relations_, same_stamp, false);
    entry.interpolated = relation_errors(trajectory, relations_, largest_gap, true);
    entry.own = relation_errors(own, relations_, largest_gap, true);
    if (!seconds.empty()) {
      entry.median_seconds = median(seconds);
      entry.p99_seconds = quantile(seconds, 0.99);
      entry.longest_seconds = quantile(seconds, 1.0);
    }
    entry.picture.title = "Map of " + file.name;
    const std::size_t every = std::max<std::size_t>(trajectory.size() / 2000, 1);
    for (std::size_t i = 0; i < trajectory.size(); i += every) {
      entry.picture.points.push_back({trajectory[i].pose.x, trajectory[i].pose.y});
    }
    for (const MapLine& line : result.map) {
      entry.picture.lines.push_back(
          {{line.start.x(), line.start.y()}, {line.end.x(), line.end.y()}});
    }
  }

  std::uint64_t seed_;
  bool timing_;
  double laps_;
  std::vector<World> worlds_;
  std::vector<ScanFile> files_;
  SensorModel noise_;
  std::vector<PoseRelation> relations_;
  std::vector<DriveEntry> drives_;
  std::vector<ScenarioEntry> scenarios_;
  std::vector<LogEntry> logs_;
};

}  // namespace

std::unique_ptr<Section> make_mapping_section(const EvaluationSetup& setup) {
  return std::make_unique<MappingSection>(setup);
}

}  // namespace quoin::deploy
