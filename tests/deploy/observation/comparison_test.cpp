// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/comparison.hpp"

#include <numbers>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "deploy/observation/comparison_report.hpp"

namespace quoin::deploy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

ScanKey scan(std::uint64_t number, std::uint64_t incarnation = 1) {
  return {"front", incarnation, number};
}

/// Corners 1 m apart, moved along x; 10 mm of noise.
CornerResult result(std::size_t count, double shift = 0.0, double latency = 0.001) {
  CornerResult made;
  made.latency = latency;
  made.methods = "iepf/wctls";
  for (std::size_t i = 0; i < count; ++i) {
    made.corners.push_back(
        {{static_cast<double>(i) + shift, 2.0}, 1e-4 * Eigen::Matrix2d::Identity()});
  }
  return made;
}

TEST(Comparison, ComparesResultsOnTheSameScan) {
  Comparison comparison({"a", "b"}, 0, {});
  comparison.add(0, scan(0), result(4, 0.0, 0.002));
  comparison.add(1, scan(0), result(3, 0.005, 0.004));
  comparison.add(1, scan(1), result(4, 0.005, 0.004));  // whoever comes first
  comparison.add(0, scan(1), result(4, 0.0, 0.002));
  EXPECT_EQ(comparison.open(), 0U);
  const ComparisonFigures figures = comparison.figures();
  EXPECT_EQ(figures.scans, 2U);
  ASSERT_THAT(figures.services, SizeIs(2));
  const ComparedService& a = figures.services[0];
  EXPECT_EQ(a.scans, 2U);
  EXPECT_EQ(a.missing, 0U);
  EXPECT_EQ(a.against.scans, 0U);
  EXPECT_EQ(a.mean_corners, 4.0);
  EXPECT_NEAR(a.median_sigma, 0.01, 1e-4);
  EXPECT_NEAR(a.median_ellipse_area, std::numbers::pi * 1e-4, 4e-6);
  EXPECT_NEAR(a.latency_p50, 0.002, 3e-5);
  const ComparedService& b = figures.services[1];
  EXPECT_EQ(b.methods, "iepf/wctls");
  EXPECT_EQ(b.mean_corners, 3.5);
  EXPECT_NEAR(b.latency_p99, 0.004, 6e-5);
  EXPECT_EQ(b.against.scans, 2U);
  EXPECT_EQ(b.against.reference_corners, 8U);
  EXPECT_EQ(b.against.own_corners, 7U);
  EXPECT_EQ(b.against.matched, 7U);
  EXPECT_EQ(b.against.share(), 7.0 / 8.0);
  EXPECT_NEAR(b.against.median_distance, 0.005, 6e-5);
  EXPECT_NEAR(b.against.distance_p95, 0.005, 6e-5);
}

TEST(Comparison, WhatAServicePassesByIsMissing) {
  Comparison comparison({"a", "b"}, 0, {});
  for (const std::uint64_t number : {0, 1, 2, 3}) comparison.add(0, scan(number), result(1));
  comparison.add(1, scan(0), result(1));
  EXPECT_EQ(comparison.figures().services[1].missing, 0U) << "may still come";
  comparison.add(1, scan(3), result(1));
  EXPECT_EQ(comparison.figures().services[1].missing, 2U);
  EXPECT_EQ(comparison.figures().services[1].against.scans, 2U);
  EXPECT_EQ(comparison.figures().services[0].missing, 0U);
  EXPECT_EQ(comparison.open(), 0U);
}

TEST(Comparison, BeforeItsFirstResultAServiceMissesNothing) {
  Comparison comparison({"a", "b"}, 0, {});
  comparison.add(0, scan(0), result(1));
  comparison.add(0, scan(1), result(1));
  comparison.add(1, scan(1), result(1));
  EXPECT_EQ(comparison.figures().services[1].missing, 0U);
}

TEST(Comparison, ASilentServiceMissesEverythingAndHoldsUpNobody) {
  Comparison comparison({"a", "b", "silent"}, 0, {});
  for (std::uint64_t number = 0; number < 200; ++number) {
    comparison.add(0, scan(number), result(2));
    comparison.add(1, scan(number), result(2));
    EXPECT_EQ(comparison.figures().services[1].against.scans, number + 1);
  }
  EXPECT_LE(comparison.open(), 64U);
  comparison.finish();
  EXPECT_EQ(comparison.figures().services[2].missing, 200U);
  EXPECT_EQ(comparison.figures().services[1].missing, 0U);
  EXPECT_EQ(comparison.figures().services[1].against.scans, 200U);
}

TEST(Comparison, AServiceFarBehindIsLateButHasMissedNothing) {
  Comparison comparison({"a", "slow"}, 0, {});
  comparison.add(1, scan(0), result(1));
  for (std::uint64_t number = 0; number < 100; ++number) comparison.add(0, scan(number), result(1));
  EXPECT_EQ(comparison.figures().services[1].missing, 35U) << "0 compared, 64 open";
  for (std::uint64_t number = 1; number < 100; ++number) comparison.add(1, scan(number), result(1));
  EXPECT_EQ(comparison.figures().services[1].missing, 0U);
  EXPECT_EQ(comparison.figures().services[1].scans, 100U);
  EXPECT_EQ(comparison.figures().services[1].against.scans, 65U);
}

TEST(Comparison, TheSameScanTwiceCountsOnce) {
  Comparison comparison({"a", "b"}, 0, {});
  for (int i = 0; i < 2; ++i) {
    comparison.add(0, scan(5), result(1));
    comparison.add(1, scan(5), result(1));
  }
  EXPECT_EQ(comparison.figures().scans, 1U);
  EXPECT_EQ(comparison.figures().services[0].scans, 1U);
  EXPECT_EQ(comparison.figures().services[1].against.scans, 1U);
}

TEST(Comparison, ARestartedSourceNumbersFromZeroAgain) {
  Comparison comparison({"a", "b"}, 0, {});
  comparison.add(0, scan(7, 1), result(1));
  comparison.add(1, scan(7, 1), result(1));
  comparison.add(0, scan(0, 2), result(1));
  comparison.add(1, scan(1, 2), result(1));
  comparison.add(0, scan(1, 2), result(1));
  comparison.finish();
  EXPECT_EQ(comparison.figures().services[1].missing, 1U);
  EXPECT_EQ(comparison.figures().services[1].against.scans, 2U);
}

TEST(Comparison, EndsAfterSoManyScans) {
  Comparison comparison({"a", "b"}, 1, {}, 2);
  comparison.add(0, scan(0), result(1));
  comparison.add(0, scan(1), result(1));
  EXPECT_TRUE(comparison.full());
  comparison.add(0, scan(2), result(1));
  comparison.add(1, scan(0), result(1));
  EXPECT_EQ(comparison.open(), 1U);
  comparison.add(1, scan(2), result(1));  // so scan 1 does not come
  EXPECT_EQ(comparison.open(), 0U);
  comparison.finish();
  const ComparisonFigures figures = comparison.figures();
  EXPECT_EQ(figures.scans, 2U);
  EXPECT_EQ(figures.services[0].scans, 2U);
  EXPECT_EQ(figures.services[1].scans, 1U);
  EXPECT_EQ(figures.services[1].missing, 1U);
}

ComparisonFigures some_figures() {
  Comparison comparison({"a", "b", "silent"}, 1, {});
  comparison.add(0, scan(0), result(2, 0.001));
  comparison.add(1, scan(0), result(4));
  comparison.finish();
  ComparisonFigures figures = comparison.figures();
  figures.deployment = "robot.yaml";
  figures.duration = 1.25;
  return figures;
}

TEST(ComparisonReport, ListsTheReferenceFirst) {
  EXPECT_THAT(
      table_lines(some_figures(), std::string::npos),
      ElementsAre(
          "corners of  scans  missing  compared  corners/scan  matched   [%]   apart [mm]  sigma "
          "[mm]  area [mm^2]  latency [ms]     methods",
          "b               1        0         -          4.00        -     -            -       "
          " 9.91       311.98   1.00 / 1.00  iepf/wctls",
          "a               1        0         1          2.00        2  50.0  1.00 / 1.00       "
          " 9.91       311.98   1.00 / 1.00  iepf/wctls",
          "silent          0        1         -          0.00        -     -            -       "
          "    -            -             -            "));
  for (const std::string& line : table_lines(some_figures(), 40)) EXPECT_LE(line.size(), 40U);
}

TEST(ComparisonReport, TellsItInALine) {
  EXPECT_EQ(progress_line(some_figures()),
            "1.2 s, 1 scans | a 0 missing, sigma 9.91 mm, 50.0 % matched, 1.00 mm apart | b 0 "
            "missing, sigma 9.91 mm | silent 1 missing");
}

TEST(ComparisonReport, IsAJsonObject) {
  const nlohmann::ordered_json json = summary(some_figures());
  EXPECT_EQ(json["deployment"], "robot.yaml");
  EXPECT_EQ(json["reference"], "b");
  EXPECT_EQ(json["scans"], 1);
  EXPECT_FALSE(json["services"]["b"].contains("against_reference"));
  EXPECT_EQ(json["services"]["silent"]["scans_missing"], 1);
  const auto& against = json["services"]["a"]["against_reference"];
  EXPECT_EQ(against["scans"], 1);
  EXPECT_EQ(against["matched"], 2);
  EXPECT_EQ(against["share_matched"], 0.5);
  EXPECT_NEAR(against["distance_p50_mm"].get<double>(), 1.0, 0.011);
}

}  // namespace
}  // namespace quoin::deploy
