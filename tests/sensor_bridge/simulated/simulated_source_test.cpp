// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/simulated_source.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/simulated/parameters.hpp"
#include "sensor_bridge/simulated/world_file.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/sensor_bridge/recording_source.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::RecordingSource;
using quoin::tests::source_config;

// NaN equals NaN here: the very same bits are meant.
bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
           return x == y || (x != x && y != y);
         });
}

TEST(SimulatedSource, PublishesEachRevolutionAtItsEndStampedWithItsBeginning) {
  const ParameterSettings settings{
      {"rate_hz", "0.1"}, {"points", "90"}, {"scans", "4"}, {"frame", "front_laser"}};
  RecordingSource source;
  const auto before = std::chrono::steady_clock::now();
  const std::int64_t epoch_before =
      std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  open_simulated(source_config(settings), "/nowhere")(source);

  ASSERT_EQ(source.scans.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto offset = std::chrono::duration<double>(source.deadlines[i] - before).count();
    EXPECT_NEAR(offset, 10.0 * static_cast<double>(i + 1), 2.0);
    const double stamp =
        static_cast<double>(source.scans[i].header().stamp() - epoch_before) * 1e-9;
    EXPECT_NEAR(stamp, 10.0 * static_cast<double>(i), 2.0);
    EXPECT_EQ(source.scans[i].header().frame(), "front_laser");
    EXPECT_EQ(source.scans[i].bearings().size(), 90U);
    EXPECT_EQ(source.scans[i].ranges().size(), 90U);
    ASSERT_EQ(source.scans[i].time_offsets().size(), 90U);
    EXPECT_EQ(source.scans[i].time_offsets().front(), 0.0F);
    EXPECT_EQ(source.scans[i].duration(), source.scans[i].time_offsets().back());
    EXPECT_NEAR(source.scans[i].duration(), 10.0 * 89 / 90, 1e-3);
    EXPECT_EQ(source.memory[i], source.memory[0]);
  }
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(source.deadlines[i] - source.deadlines[i - 1], std::chrono::seconds(10));
  }
}

TEST(SimulatedSource, PublishesOdometryAndTheTruthIfAskedTo) {
  const ParameterSettings settings{
      {"rate_hz", "10"}, {"speed", "0.5"},           {"scans", "5"},       {"odometry", "true"},
      {"truth", "true"}, {"odometry_rate_hz", "20"}, {"wheel_noise", "0"}, {"wheel_slip", "0.1"}};
  RecordingSource source;
  open_simulated(source_config(settings), "/nowhere")(source);
  ASSERT_EQ(source.scans.size(), 5U);
  ASSERT_EQ(source.poses.size(), 5U);
  ASSERT_EQ(source.odometry.size(), 11U) << "up to the end of the last scan";
  const auto way = [](const msg::PoseEstimate& from, const msg::PoseEstimate& to) {
    return std::hypot(to.x() - from.x(), to.y() - from.y());
  };
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(source.poses[i].header().stamp(), source.scans[i].header().stamp());
  }
  EXPECT_LT(source.odometry[0].header().stamp(), source.scans[0].header().stamp());
  EXPECT_NEAR(
      static_cast<double>(source.odometry[8].header().stamp() - source.scans[4].header().stamp()),
      -1e6, 1e5);
  EXPECT_EQ(source.odometry[0].pose().x(), 0.0);
  EXPECT_NEAR(way(source.odometry[0].pose(), source.odometry[8].pose()), 1.1 * (0.2 - 0.0005),
              1e-9);
  EXPECT_NEAR(way(source.poses[0].pose(), source.poses[4].pose()), 0.2, 1e-9);
  EXPECT_GT(source.odometry[8].pose().covariance_xx(), 0.0);
  EXPECT_EQ(source.poses[0].header().frame(), "map");

  RecordingSource quiet;
  open_simulated(source_config({{"rate_hz", "10"}, {"speed", "0.5"}, {"scans", "5"}}),
                 "/nowhere")(quiet);
  EXPECT_TRUE(quiet.odometry.empty() && quiet.poses.empty());
  EXPECT_TRUE(same(quiet.scans[4].ranges(), source.scans[4].ranges()));
}

TEST(SimulatedSource, DeclaresItsSensorModel) {
  RecordingSource source;
  open_simulated(source_config({{"scans", "1"},
                                {"range_min", "0.3"},
                                {"range_max", "12"},
                                {"range_stddev", "0.02"},
                                {"bearing_stddev", "0.003"},
                                {"range_bias", "0.5"},
                                {"range_bias_stddev", "0.004"}}),
                 "/nowhere")(source);
  ASSERT_EQ(source.scans.size(), 1U);
  EXPECT_EQ(source.scans[0].sensor_model().range_stddev(), 0.02);
  EXPECT_EQ(source.scans[0].sensor_model().bearing_stddev(), 0.003);
  EXPECT_EQ(source.scans[0].sensor_model().range_bias_stddev(), 0.004);
  EXPECT_EQ(source.scans[0].range_min(), 0.3F);
  EXPECT_EQ(source.scans[0].range_max(), 12.0F);
}

TEST(SimulatedSource, SameSeedSameScansWhileMoving) {
  const ParameterSettings settings{
      {"rate_hz", "4"}, {"speed", "0.5"}, {"seed", "7"}, {"scans", "5"}};
  RecordingSource source;
  open_simulated(source_config(settings), "/nowhere")(source);
  ASSERT_EQ(source.scans.size(), 5U);

  const auto parameters = make_parameters<SimulatedParameters>(settings);
  SimulatedScanner scanner(load_world(parameters.environment, "/nowhere"),
                           scanner_settings(parameters), 7);
  SimulatedScan expected;
  for (std::size_t i = 0; i < 5; ++i) {
    scanner.scan(0.5 * 0.25 * static_cast<double>(i), 0.5, expected);
    EXPECT_TRUE(same(source.scans[i].bearings(), expected.bearings));
    EXPECT_TRUE(same(source.scans[i].ranges(), expected.ranges));
  }

  RecordingSource other;
  open_simulated(source_config({{"rate_hz", "4"}, {"speed", "0.5"}, {"seed", "8"}, {"scans", "1"}}),
                 "/nowhere")(other);
  EXPECT_FALSE(same(other.scans.at(0).ranges(), source.scans[0].ranges()));
}

TEST(SimulatedSource, RunsUntilAskedToStop) {
  RecordingSource source;
  source.stop_after = 20;
  open_simulated(source_config({}), "/nowhere")(source);
  EXPECT_EQ(source.scans.size(), 20U);
}

TEST(SimulatedSource, RefusesAnUnknownWorldWhenOpened) {
  EXPECT_THAT(
      error_of<WorldError>([] {
        (void)open_simulated(source_config({{"environment", "domestic_rom"}}), "/nowhere");
      }),
      ::testing::StartsWith("unknown environment 'domestic_rom'; did you mean 'domestic_room'?"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
