// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/circles/circle_fitters.hpp"
#include "core/corners/corner_finders.hpp"
#include "core/evaluation/circle_consistency.hpp"
#include "core/evaluation/line_coverage.hpp"
#include "core/evaluation/loop_coverage.hpp"
#include "core/evaluation/papers/cwlf_paper.hpp"
#include "core/evaluation/papers/pca_paper.hpp"
#include "core/evaluation/papers/published_figures.hpp"
#include "core/evaluation/papers/wctls_paper.hpp"
#include "core/evaluation/scan_statistics.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/jobs.hpp"
#include "deploy/evaluation/progress_display.hpp"
#include "deploy/evaluation/sections.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::deploy {
namespace {

using nlohmann::json;
using quoin::tests::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

bool always(const EvaluationProgress&) { return true; }

/// Few trials of two fitters, nothing that depends on time.
EvaluationOptions quick(const std::string& section) {
  EvaluationOptions options;
  options.only = {section};
  options.fitters = {"utls", "wctls"};
  options.segmenters = {"iepf"};
  options.trials = 40;
  options.scans_per_world = 3;
  options.laps = 0.02;
  options.scenarios = 0;
  options.timing = false;
  options.version = "1.2.3";
  return options;
}

json report_of(const EvaluationOptions& options) {
  return json::parse(evaluate(prepare(options), always).json);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

/// A scan of the square room as a CSV file.
std::string csv_scan() {
  ScannerSettings settings;
  SimulatedScanner scanner(built_in_world("square_room").value(), settings, 4);
  SimulatedScan scan;
  scanner.scan(0.0, 0.0, scan);
  std::string text;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    text += std::to_string(scan.bearings[i]) + "," + std::to_string(scan.ranges[i]) + "\n";
  }
  return text;
}

TEST(Evaluation, MapsAndPosesAreJudgedByTheTruth) {
  EvaluationOptions options = quick("mapping");
  options.worlds = {"square_room"};
  options.laps = 0.2;
  const json report = report_of(options)["mapping"];
  EXPECT_TRUE(report["scenarios"].empty());
  EXPECT_TRUE(report["logs"].empty());
  ASSERT_EQ(report["simulated"].size(), 4U);
  for (const json& drive : report["simulated"]) {
    EXPECT_EQ(drive["environment"], "square_room");
    EXPECT_EQ(drive["tracking"], drive["scans"]);
    EXPECT_LT(drive["translation_median"], 0.05);
    EXPECT_GT(drive["map_recall"], 0.9);
  }
}

TEST(Evaluation, ConsistencyIsThatOfADirectComputation) {
  const json report = report_of(quick("consistency"));
  EXPECT_EQ(report["version"], "1.2.3");
  EXPECT_EQ(report["seed"], 1);
  EXPECT_EQ(report["trials"], 40);
  EXPECT_EQ(report["options"]["fitters"], json({"utls", "wctls"}));
  // Two fitters in two modes, two environments, two noises.
  ASSERT_EQ(report["fitters"].size(), 16U);
  const json& entry = report["fitters"][0];
  EXPECT_EQ(entry["name"], "utls");
  EXPECT_EQ(entry["covariance"], "propagated");
  EXPECT_EQ(entry["environment"], "environment_a");
  EXPECT_DOUBLE_EQ(entry["range_stddev"].get<double>(), 0.05);
  EXPECT_NEAR(entry["bearing_stddev"].get<double>(), 0.391 * 3.14159265 / 180.0, 1e-9);

  const World world = built_in_world("environment_a").value();
  const SensorModel noise = data_sheet_model();
  const Consistency direct = judge_consistency(
      make_fitter("utls", "propagated"), observe(world, world.pose_at(0.0), 935), noise, 40,
      derived_seed(1, "consistency/environment_a/" + noise_text(noise)));
  EXPECT_EQ(entry["nees"].get<double>(), direct.nees.value);
  EXPECT_EQ(entry["coverage95"].get<double>(), direct.coverage95.value);
  EXPECT_EQ(entry["coverage95_interval"][0].get<double>(), direct.coverage95.low);
  EXPECT_EQ(entry["coverage95_interval"][1].get<double>(), direct.coverage95.high);
  EXPECT_EQ(entry["rmse_over_crb"].get<double>(), direct.rmse_over_crb);
  EXPECT_EQ(entry["worst_corner"].get<double>(), direct.worst_corner);
  EXPECT_TRUE(entry["failures"].empty());
}

TEST(Evaluation, AWorldWithoutCornersHasNoFigures) {
  const TemporaryFolder folder;
  EvaluationOptions options = quick("consistency");
  options.fitters = {"wctls"};
  options.worlds = {folder
                        .write("wall.yaml",
                               "walls:\n  - {points: [[2, -3], [2, 3]], closed: false}\n"
                               "path:\n  - [0, 0, 0]\n")
                        .string()};
  const json report = report_of(options);
  EXPECT_EQ(report["fitters"][0]["environment"], "wall");
  EXPECT_EQ(report["fitters"][0]["corners"], 0);
  EXPECT_TRUE(report["fitters"][0]["nees"].is_null());
  EXPECT_TRUE(report["fitters"][0]["coverage95"].is_null());
}

TEST(Evaluation, LinesAreThoseOfADirectComputation) {
  const json report = report_of(quick("lines"));
  const auto& cells = report["lines"];
  const auto cell = std::find_if(cells.begin(), cells.end(), [](const json& each) {
    return each["range_stddev"] == 0.01 && each["incidence"] == 0.0 && each["length"] == 0.3 &&
           each["distance"] == 2.0;
  });
  ASSERT_NE(cell, cells.end());
  const LineCoverage direct = judge_wall(
      make_fitter("inverse_range", "propagated"), {0.3, 2.0, 0.0}, rplidar_noise(0.01), 920, 5, 80,
      derived_seed(1, "lines/" + noise_text(rplidar_noise(0.01)) + "/0.00/0.3/2.0"));
  EXPECT_EQ((*cell)["trials"], 80);
  EXPECT_EQ((*cell)["points"].get<double>(), direct.points);
  EXPECT_EQ((*cell)["coverage_middle"].get<double>(), direct.middle.value);
  EXPECT_EQ((*cell)["coverage_alpha_r"].get<double>(), direct.alpha_r.value);
  // A short wall far away is met by too few rays.
  for (const json& each : cells) EXPECT_FALSE(each["length"] == 0.2 && each["distance"] == 10.0);
}

TEST(Evaluation, CirclesAreThoseOfADirectComputation) {
  const json report = report_of(quick("circles"));
  const json& cells = report["circles"]["cells"];
  const auto cell = std::find_if(cells.begin(), cells.end(), [](const json& each) {
    return each["name"] == "taubin" && each["radius"] == 0.5 && each["distance"] == 1.5 &&
           each["range_stddev"] == 0.003;
  });
  ASSERT_NE(cell, cells.end());
  const SensorModel noise = rplidar_noise(0.003);
  const CircleConsistency direct = judge_circle_consistency(
      CircleFitters::make<CircleFitter>("taubin", {}), {0.5, 1.5}, noise, 40,
      derived_seed(1, "circles/column of 0.50 m at 1.0 m/" + noise_text(noise)));
  EXPECT_EQ((*cell)["found"], 40);
  EXPECT_EQ((*cell)["coverage95"].get<double>(), direct.coverage95.value);
  EXPECT_EQ((*cell)["coverage95_center"].get<double>(), direct.coverage95_center.value);
  EXPECT_EQ((*cell)["rmse_over_crb"].get<double>(), direct.rmse_over_crb.value);
  EXPECT_EQ((*cell)["rmse_over_crb_interval"][0].get<double>(), direct.rmse_over_crb.low);
  // As large as the noise: there is nothing to find, and no figures of it.
  const auto lost = std::find_if(cells.begin(), cells.end(), [](const json& each) {
    return each["radius"] == 0.05 && each["range_stddev"] == 0.05 && each["found"] == 0;
  });
  ASSERT_NE(lost, cells.end());
  EXPECT_FALSE(lost->contains("coverage95"));
  EXPECT_GT((*lost)["failures"]["not_determined"].get<int>(), 30);
}

TEST(Evaluation, LoopIsThatOfADirectComputation) {
  EvaluationOptions options = quick("loop");
  options.worlds = {"corridor", "square_room"};
  const json report = report_of(options);
  ASSERT_EQ(report["loop"].size(), 4U);
  const json& entry = report["loop"][3];
  EXPECT_EQ(entry["fitter"], "wctls");
  EXPECT_EQ(entry["environment"], "square_room");
  Extraction extraction(make_segmenter("iepf"), make_fitter("wctls", "propagated"),
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  const World world = built_in_world("square_room").value();
  const LoopCoverage direct = judge_loop(extraction, {&world, 1},
                                         {.scans = 3, .seed = derived_seed(1, "loop/square_room")});
  EXPECT_EQ(entry["coverage95"].get<double>(), direct.corners.coverage.value);
  EXPECT_EQ(entry["recall"].get<double>(), direct.corners.recall.value);
  EXPECT_EQ(entry["precision"].get<double>(), direct.corners.precision.value);
  EXPECT_EQ(entry["line_coverage95"].get<double>(), direct.lines.coverage.value);
  EXPECT_EQ(entry["corners_per_scan"].get<double>(), direct.corners_per_scan);
  EXPECT_EQ(entry["nees"].get<double>(), direct.corners.nees.value);
}

TEST(Evaluation, WorldsAreThoseOfADirectComputation) {
  const TemporaryFolder folder;
  // A partition that ends on a wall makes corners on both sides.
  folder.write("flat.yaml",
               "walls:\n  - {points: [[0, 0], [6, 0], [6, 4], [0, 4]], closed: true}\n"
               "  - {points: [[3, 0], [3, 2.5]], closed: false}\npath:\n  - [1.5, 1.5, 0]\n");
  folder.write("notes.txt", "not a world");
  EvaluationOptions options = quick("worlds");
  options.worlds = {folder.path().string()};
  options.scans_per_world = 500;
  const json report = report_of(options);
  ASSERT_EQ(report["worlds"].size(), 2U);  // at 10 and at 30 mm
  const json& entry = report["worlds"][0];
  EXPECT_EQ(entry["name"], "flat");
  EXPECT_EQ(entry["fitter"], "utls");  // the first that is judged
  EXPECT_EQ(entry["scans"], 500);
  Extraction extraction(make_segmenter("iepf"), make_fitter("utls", "propagated"),
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  const World world = prepare(options).worlds.front();
  const LoopCoverage direct =
      judge_loop(extraction, {&world, 1}, {.scans = 500, .seed = derived_seed(1, "worlds/flat")});
  EXPECT_EQ(entry["recall"].get<double>(), direct.corners.recall.value);
  EXPECT_EQ(entry["coverage95"].get<double>(), direct.corners.coverage.value);
  EXPECT_EQ(entry["line_coverage95"].get<double>(), direct.lines.coverage.value);
  // (0, 0), (0, 4) and (3, 0) are near enough to be seen in each scan.
  EXPECT_GE(entry["judged_corners"].get<int>(), 1);
  EXPECT_LT(entry["judged_corners_coverage95"][0].get<double>(),
            entry["judged_corners_coverage95"][1].get<double>() + 1e-12);
  EXPECT_GT(entry["judged_corners_coverage95"][0].get<double>(), 0.9);
}

TEST(Evaluation, WorldsAtRandomAreRoomsFlatsAndHalls) {
  EvaluationOptions options = quick("worlds");
  options.scans_per_world = 8;  // two of each
  const json report = report_of(options);
  // Three styles at two noises, rooms with strays, and with few rays.
  ASSERT_EQ(report["worlds"].size(), 3U * 2U + 1U + 4U);
  EXPECT_EQ(report["worlds"][0]["name"], "rooms");
  EXPECT_EQ(report["worlds"][0]["worlds"], 40);
  EXPECT_EQ(report["worlds"][0]["scans"], 80);
  EXPECT_GT(report["worlds"][0]["recall"].get<double>(), 0.9);
  EXPECT_EQ(report["worlds"][5]["name"], "halls");
  EXPECT_EQ(report["worlds"][6]["strays"], 0.03);
  EXPECT_EQ(report["worlds"][10]["rays"], 32);
  EXPECT_EQ(report["worlds"][0]["judged_corners"], 0);
  EXPECT_TRUE(report["worlds"][0]["judged_corners_coverage95"].is_null());
}

TEST(Evaluation, PublishedFiguresStandBesideOurs) {
  const json report = report_of(quick("wctls_paper"));
  bool found = false;
  for (const json& entry : report["published"]) {
    EXPECT_THAT(entry["paper"].get<std::string>(), HasSubstr("WCTLS"));
    EXPECT_GT(entry["published"].get<double>(), 0.0);
    EXPECT_GT(entry["measured"].get<double>(), 0.0);
    if (entry["quantity"] != "ratio of areas utls / wctls, environment_a, as_published here") {
      continue;
    }
    found = true;
    EXPECT_EQ(entry["place"], "Fig. 4 a");
    EXPECT_NEAR(entry["published"].get<double>(), 4498.5 / 626.2, 1e-12);
    EXPECT_GT(entry["measured"].get<double>(), 4.0);
  }
  EXPECT_TRUE(found);
  // Per mode: 3 medians of x and y, 3 areas and a ratio, in two environments.
  EXPECT_EQ(report["published"].size(), 2U * 2U * (3U * 2U + 3U + 1U));
  const json& environment = report["wctls_paper"]["environments"][1];
  EXPECT_EQ(environment["corners"].size(), 23U);
  ASSERT_EQ(environment["methods"].size(), 6U);
  EXPECT_EQ(environment["methods"][0]["median_ellipse_areas"].size(), 100U);
  EXPECT_EQ(environment["methods"][0]["sigma_x"].size(), 23U);
}

TEST(Evaluation, CwlfPaperIsThatOfADirectComputation) {
  const json report = report_of(quick("cwlf_paper"));
  const json& environments = report["cwlf_paper"]["environments"];
  ASSERT_EQ(environments.size(), 2U);
  EXPECT_EQ(environments[0]["environment"], "cwlf_environment_a");
  EXPECT_EQ(environments[0]["walls"], 36);
  EXPECT_EQ(environments[0]["corners"].size(), 23U);
  EXPECT_EQ(environments[1]["walls"], 18);
  ASSERT_EQ(environments[1]["methods"].size(), 4U);
  const SensorModel noise = rplidar_noise(0.010);
  const CwlfPaperEnvironment direct = measure_cwlf_paper(
      built_in_world("cwlf_environment_b").value(),
      {{"cwlf", CovarianceMode::as_published, make_fitter("cwlf", "as_published")}}, noise,
      derived_seed(1, "cwlf_paper/cwlf_environment_b"));
  const json& method = environments[1]["methods"][0];
  EXPECT_EQ(method["fitter"], "cwlf");
  EXPECT_EQ(method["covariance"], "as_published");
  ASSERT_EQ(method["sigma_x"].size(), 15U);
  double sum = 0.0;
  for (std::size_t k = 0; k < 15; ++k) {
    const Eigen::Matrix2d& covariance = direct.methods[0].corners[k]->covariance;
    EXPECT_EQ(method["sigma_y"][k].get<double>(), std::sqrt(covariance(1, 1)));
    sum += 1e3 * std::sqrt(covariance(0, 0));
  }

  CwlfPaperCorner expected = cwlf_paper_corners()[2];
  const json& corner = report["cwlf_paper"]["corners"][2];
  EXPECT_EQ(report["cwlf_paper"]["corners"].size(), cwlf_paper_corners().size());
  EXPECT_EQ(corner["method"], "arras_siegwart_literal");
  EXPECT_EQ(corner["points"], 10);
  compute_corner(expected, noise, derived_seed(1, "cwlf_paper/130/10"));
  EXPECT_EQ(corner["sigma_x"].get<double>(), std::sqrt(expected.corner->covariance(0, 0)));
  EXPECT_TRUE(corner["seconds"].is_null());

  // Two methods, x and y, two modes, two environments; two figures, x and y, two modes; shares.
  ASSERT_EQ(report["published"].size(), 2U * 2U * 2U * 2U + 2U * 2U * 2U + 3U);
  bool found = false;
  for (const json& entry : report["published"]) {
    const std::string quantity = entry["quantity"];
    EXPECT_EQ(entry["measured"].is_null(), quantity.starts_with("share of time")) << quantity;
    if (quantity != "mean sigma_x over the corners, cwlf, cwlf_environment_b, as_published here") {
      continue;
    }
    found = true;
    EXPECT_EQ(entry["place"], "Table II");
    EXPECT_NEAR(entry["published"].get<double>(), 25.86, 0.01);
    EXPECT_NEAR(entry["measured"].get<double>(), sum / 15.0, 1e-9);
  }
  EXPECT_TRUE(found);
}

TEST(Evaluation, PcaPaperIsThatOfADirectComputation) {
  const json report = report_of(quick("pca_paper"));
  EXPECT_EQ(report["pca_paper"]["trials"], 200);
  const std::vector<PcaSimulation> simulations = pca_simulations();
  ASSERT_EQ(report["pca_paper"]["simulations"].size(), simulations.size());
  const json& entry = report["pca_paper"]["simulations"][1];
  const PcaComparison direct = compare_pca(simulations[1], 200, derived_seed(1, "pca_paper/1"));
  EXPECT_EQ(entry["points"], simulations[1].points);
  EXPECT_EQ(entry["pca"]["angle_rmse"].get<double>(), direct.pca.angle_rmse);
  EXPECT_EQ(entry["least_squares"]["residual"].get<double>(), direct.least_squares.residual);
  EXPECT_TRUE(entry["pca"]["seconds"].is_null());
}

TEST(Evaluation, SegmentersAreJudgedAtFourNoises) {
  const json report = report_of(quick("segmenters"));
  ASSERT_EQ(report["segmenters"].size(), 4U);
  std::set<double> noises;
  for (const json& entry : report["segmenters"]) {
    EXPECT_EQ(entry["name"], "iepf");
    noises.insert(entry["range_stddev"].get<double>());
    EXPECT_GE(entry["true_positive_rate"].get<double>(), 0.0);
    EXPECT_LE(entry["true_positive_rate_interval"][0].get<double>(),
              entry["true_positive_rate"].get<double>());
    EXPECT_GE(entry["false_positive_rate_interval"][1].get<double>(),
              entry["false_positive_rate"].get<double>());
    EXPECT_TRUE(entry["scans_per_second"].is_null());
  }
  EXPECT_THAT(noises, ElementsAre(0.003, 0.010, 0.020, 0.050));
}

TEST(Evaluation, TimesAreMeasuredUnlessTheyAreUnwanted) {
  EvaluationOptions options = quick("segmenters");
  options.timing = true;
  options.worlds = {"square_room"};
  EXPECT_GT(report_of(options)["segmenters"][0]["scans_per_second"].get<double>(), 0.0);
  options.only = {"cwlf_paper"};
  const EvaluationReport cwlf = evaluate(prepare(options), always);
  const json report = json::parse(cwlf.json);
  for (const json& corner : report["cwlf_paper"]["corners"]) {
    for (const char* step : {"lines", "line_covariances", "position", "covariance", "all"}) {
      EXPECT_GT(corner["seconds"][step].get<double>(), 0.0);
    }
  }
  // Two environments; times and ratios; steps of two corners.
  EXPECT_EQ(count(cwlf.html, "<svg"), 2U + 2U + 2U);
}

TEST(Evaluation, TimesOfFitsStandBesideAPlainCovariance) {
  EvaluationOptions options = quick("consistency");
  options.trials = 2;
  for (const bool timing : {false, true}) {
    options.timing = timing;
    const json times = report_of(options)["fit_times"];
    ASSERT_EQ(times.size(), 3U);
    EXPECT_EQ(times[0]["name"], "utls");
    EXPECT_EQ(times[1]["name"], "wctls");
    EXPECT_EQ(times[2]["name"], "plain_covariance");
    for (const json& time : times) {
      EXPECT_EQ(time["points"], 100);
      EXPECT_EQ(time["seconds"].is_null(), !timing);
      EXPECT_EQ(time["over_covariance"].is_null(), !timing);
      if (!timing) continue;
      EXPECT_GT(time["seconds"].get<double>(), 0.0);
      EXPECT_DOUBLE_EQ(time["over_covariance"].get<double>(),
                       time["seconds"].get<double>() / times[2]["seconds"].get<double>());
    }
    EXPECT_EQ(evaluate(prepare(options), always).html.find("Time of a fit") != std::string::npos,
              timing);
  }
}

TEST(Evaluation, ScanFilesAreExtracted) {
  const TemporaryFolder folder;
  EvaluationOptions options = quick("scans");
  options.scans = {folder.write("room.csv", csv_scan()).string()};
  const json report = report_of(options);
  ASSERT_EQ(report["scan_files"].size(), 2U);
  const json& entry = report["scan_files"][1];
  EXPECT_EQ(entry["file"], options.scans.front());
  EXPECT_EQ(entry["fitter"], "wctls");
  EXPECT_EQ(entry["scans"], 1);
  EXPECT_EQ(entry["segments_per_scan"], 4.0);
  EXPECT_EQ(entry["corners_per_scan"], 4.0);
  // 230 points a wall: 0.1 of standard error, and the fit is a median of four.
  EXPECT_NEAR(entry["median_reduced_chi_square"].get<double>(), 1.0, 0.3);
  EXPECT_GT(entry["median_sigma"].get<double>(), 0.0005);
  EXPECT_LT(entry["median_sigma"].get<double>(), 0.01);
  EXPECT_TRUE(entry["scans_per_second"].is_null());
  const json& consistency = entry["consistency"];
  EXPECT_EQ(consistency["lines"], 4);
  EXPECT_NEAR(consistency["reduced_chi_square"].get<double>(), 1.0, 0.3);
  EXPECT_EQ(consistency["odd_even"]["lines"], 4);
  EXPECT_EQ(consistency["halves"]["lines"], 4);
  EXPECT_GT(consistency["halves"]["mean"].get<double>(), 0.0);
  // One scan is compared with none.
  EXPECT_EQ(consistency["scans_at_rest"], 0);
  EXPECT_EQ(consistency["at_rest"]["lines"], 0);
  EXPECT_TRUE(consistency["at_rest"]["inside95"].is_null());
}

TEST(Evaluation, ScanFilesAreJudgedByTheGivenNoise) {
  const TemporaryFolder folder;
  EvaluationOptions options = quick("scans");
  options.scans = {folder.write("room.csv", csv_scan()).string()};
  const json plain = report_of(options);
  options.scan_noise.range_stddev *= 2.0;
  options.scan_noise.bearing_stddev *= 2.0;
  const json wide = report_of(options);
  EXPECT_EQ(wide["options"]["scan_noise"]["range_stddev"], 0.020);
  EXPECT_EQ(wide["scan_files"][0]["range_stddev"], 0.020);
  EXPECT_NEAR(wide["scan_files"][0]["consistency"]["reduced_chi_square"].get<double>(),
              0.25 * plain["scan_files"][0]["consistency"]["reduced_chi_square"].get<double>(),
              0.01);
}

TEST(Evaluation, IsTheSameForEveryNumberOfThreadsAndDiffersBySeed) {
  const TemporaryFolder folder;
  EvaluationOptions options = quick("");
  options.only.clear();
  options.trials = 25;
  options.scans = {folder.write("room.csv", csv_scan()).string()};
  const EvaluationReport one = evaluate(prepare(options), always);
  options.threads = 4;
  const EvaluationReport four = evaluate(prepare(options), always);
  EXPECT_EQ(one.json, four.json);
  EXPECT_EQ(one.html, four.html);
  EXPECT_EQ(one.summary, four.summary);
  options.seed = 2;
  const json other = report_of(options);
  EXPECT_NE(other["fitters"], json::parse(one.json)["fitters"]);
  EXPECT_NE(other["loop"], json::parse(one.json)["loop"]);
}

TEST(Evaluation, HtmlHasEveryPlotAndNeedsNoNetwork) {
  const TemporaryFolder folder;
  EvaluationOptions options = quick("");
  options.only.clear();
  options.trials = 25;
  options.scans = {folder.write("room.csv", csv_scan()).string()};
  const std::string html = evaluate(prepare(options), always).html;
  const std::string name_space = "xmlns=\"http://www.w3.org/2000/svg\"";
  EXPECT_EQ(count(html, "http"), count(html, name_space));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  // WCTLS paper: two pictures and a box plot in each environment; consistency: two charts in each
  // of four settings; the loop: one; segmenters: four; one scan file with its quantiles; PCA paper:
  // one for each table; CWLF paper: two environments.
  EXPECT_EQ(count(html, "<svg"), 2U * 3U + 4U * 2U + 1U + 4U + 2U + 3U + 2U);
  EXPECT_EQ(count(html, "<svg"), count(html, "</svg>"));
  for (const SectionKind& kind : section_kinds()) EXPECT_THAT(html, HasSubstr(kind.title));
  for (const char* title :
       {"Corner uncertainty in environment_b, propagated", "Median ellipse area per scan",
        "Coverage of the 95 % ellipses, environment_a, 50 mm, 0.391 deg",
        "RMSE over Cramer-Rao bound, environment_b, 10 mm, 0.113 deg", "segmented by iepf",
        "True positive rate", "False positive rate", "Scatter of alpha", "Scatter of r",
        "95 % ellipses, enlarged"}) {
    EXPECT_THAT(html, HasSubstr(title));
  }
  EXPECT_THAT(html, Not(HasSubstr(">nan<")));
}

TEST(Evaluation, TellsItsProgressAndEndsWhenAsked) {
  EvaluationOptions options = quick("loop");
  std::vector<EvaluationProgress> told;
  (void)evaluate(prepare(options), [&](const EvaluationProgress& progress) {
    told.push_back(progress);
    return true;
  });
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().total, 2 * world_names().size());  // two fitters in every world
  EXPECT_EQ(told.back().done, told.back().total);
  EXPECT_THAT(told.back().finished, ElementsAre("loop"));
  options.trials = 1000000000;
  options.only = {"consistency"};
  EXPECT_THROW((void)evaluate(prepare(options), [](const auto&) { return false; }), Interrupted);
}

TEST(Evaluation, ReportsAreWrittenWholeIntoANewFolder) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "a" / "b";
  write_report({"{}\n", "<html>", {}}, target);
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(target)) {
    names.insert(entry.path().filename());
  }
  EXPECT_THAT(names, ElementsAre("report.html", "report.json"));
  std::ifstream file(target / "report.json");
  EXPECT_EQ(json::parse(file), json::object());
  EXPECT_THROW(write_report({}, folder.write("file", "")), std::runtime_error);
}

TEST(ProgressDisplay, DrawsABarOrALineForEachSection) {
  const EvaluationProgress progress{5, 10, "loop", "iepf and wctls in corridor", {"consistency"}};
  const std::string bar = progress_bar(progress, 10.0, 200);
  EXPECT_THAT(bar, HasSubstr("[############............] 50 %, 10 s left  loop: iepf and wctls"));
  EXPECT_EQ(progress_bar(progress, 10.0, 30).size(), 30U);
  EXPECT_THAT(progress_bar({0, 0, "", "", {}}, 0.0, 80), HasSubstr("100 %"));

  std::ostringstream lines;
  {
    ProgressDisplay display(lines, false, 80);
    display.show(progress);
    display.show(progress);
  }
  EXPECT_EQ(count(lines.str(), "\n"), 1U);
  EXPECT_THAT(lines.str(), HasSubstr("consistency: done after"));
  std::ostringstream terminal;
  {
    ProgressDisplay display(terminal, true, 80);
    display.show(progress);
  }
  EXPECT_EQ(count(terminal.str(), "\n"), 0U);
  EXPECT_TRUE(terminal.str().ends_with("\r\033[K"));
}

}  // namespace
}  // namespace quoin::deploy
