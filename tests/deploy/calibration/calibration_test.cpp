// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/calibration/calibration.hpp"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/extraction/extraction.hpp"
#include "core/simulation/scanner.hpp"
#include "deploy/calibration/calibration_report.hpp"

namespace quoin::deploy {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const auto go_on = [](double) { return true; };

class CalibrationTest : public testing::Test {
 protected:
  CalibrationTest() {
    world_.add_polyline({{3.0, -1.5}, {3.0, 2.0}, {-2.0, 2.0}, {-2.0, -1.5}}, true);
    world_.path = {{0.0, 0.0, 0.0}};
    settings_.noise = {0.015, 0.002, 0.0};
  }

  CollectedScans scans(int count) {
    CollectedScans result;
    SimulatedScanner scanner(world_, settings_, 1);
    SimulatedScan scan;
    for (int i = 0; i < count; ++i) {
      scanner.scan(0.0, 0.0, scan);
      result.add(view(scan, settings_));
    }
    return result;
  }

  World world_;
  ScannerSettings settings_;
};

TEST_F(CalibrationTest, MeasuresTheNoiseOfASensorAtRest) {
  const auto calibration = calibrate(scans(60), std::nullopt, go_on);
  ASSERT_TRUE(calibration);
  EXPECT_THAT(shortcomings(*calibration), IsEmpty());
  EXPECT_NEAR(calibration->noise.components.range_stddev, 0.015, 0.0005);
  EXPECT_NEAR(calibration->noise.components.bearing_stddev, 0.002, 0.0002);
  EXPECT_LT(calibration->noise.components.flatness_stddev, 0.0015);
  EXPECT_FALSE(calibration->bias);
}

TEST_F(CalibrationTest, ATrueDistanceShowsTheBias) {
  settings_.range_bias = 0.02;
  const auto calibration = calibrate(scans(60), 3.0, go_on);
  ASSERT_TRUE(calibration && calibration->bias);
  EXPECT_EQ(calibration->bias->scans, 60U);
  EXPECT_NEAR(calibration->bias->bias.value, 0.02, 0.0005);
  EXPECT_LE(calibration->bias->bias.low, 0.0201);
  EXPECT_GE(calibration->bias->bias.high, 0.0199);
  EXPECT_THAT(sensor_block(*calibration, "x"), HasSubstr("\n  range_bias_stddev: 0.02"));

  const auto wrong = calibrate(scans(60), 2.5, go_on);
  ASSERT_TRUE(wrong);
  EXPECT_THAT(shortcomings(*wrong), Contains(HasSubstr("within 0.3 m of 2.5 m")));
}

TEST_F(CalibrationTest, SaysWhatIsMissing) {
  const auto few = calibrate(scans(2), std::nullopt, go_on);
  ASSERT_TRUE(few);
  EXPECT_THAT(shortcomings(*few), Contains(HasSubstr("only 8 walls")));
  const auto none = calibrate(CollectedScans(), std::nullopt, go_on);
  ASSERT_TRUE(none);
  EXPECT_THAT(shortcomings(*none), Contains(HasSubstr("only 0 walls")));
  EXPECT_THAT(calibration_lines(*none), testing::Not(IsEmpty()));
  EXPECT_EQ(calibration_json(*none)["range_stddev"]["high"], nullptr);
}

TEST_F(CalibrationTest, EndsWhenAskedTo) {
  int calls = 0;
  EXPECT_FALSE(calibrate(scans(20), std::nullopt, [&calls](double) { return ++calls < 30; }));
  EXPECT_EQ(calls, 30);
}

TEST_F(CalibrationTest, WritesABlockForTheDeployment) {
  const auto calibration = calibrate(scans(60), std::nullopt, go_on);
  ASSERT_TRUE(calibration);
  const std::string block = sensor_block(*calibration, "run\n.log");
  EXPECT_THAT(block, StartsWith(std::string(calibration_marker) + " from run?.log: 60 scans"));
  EXPECT_THAT(block, HasSubstr("\nsensor:\n  range_stddev: 0.01"));
  for (const char* key : {"range_stddev_per_metre", "bearing_stddev", "flatness_stddev"}) {
    EXPECT_THAT(block, HasSubstr("\n  " + std::string(key) + ": "));
  }
  EXPECT_THAT(calibration_page(*calibration, "<run>"), HasSubstr("&lt;run&gt;"));
}

TEST(CollectedScansTest, KeepsScansSpreadOverAll) {
  CollectedScans scans(100);
  const std::vector<float> bearings(10, 0.0F);
  for (int i = 0; i < 100; ++i) {
    scans.add({bearings, std::vector<float>(10, static_cast<float>(i))});
  }
  EXPECT_EQ(scans.added(), 100U);
  ASSERT_LE(scans.size(), 10U);
  ASSERT_GE(scans.size(), 5U);
  for (std::size_t k = 1; k < scans.size(); ++k) {
    EXPECT_EQ(scans.scan(k).ranges[0] - scans.scan(k - 1).ranges[0], 16.0F);
  }
}

}  // namespace
}  // namespace quoin::deploy
