// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/playback.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::sensor_bridge {
namespace {

using Stamps = std::vector<std::optional<double>>;
using ::testing::DoubleNear;
using ::testing::Pointwise;

RecordedScan scan_at(std::optional<double> stamp) {
  RecordedScan scan;
  scan.stamp = stamp;
  return scan;
}

// Due times of a player that is never late, the first scan being due at 5 s on its clock.
std::vector<double> due_times(Playback& playback, const Stamps& stamps) {
  std::vector<double> times;
  double now = 5.0;
  for (const auto& stamp : stamps) {
    now = playback.due(scan_at(stamp), now);
    times.push_back(now - 5.0);
  }
  return times;
}

MATCHER_P(Times, expected, "") {
  return ::testing::ExplainMatchResult(Pointwise(DoubleNear(1e-9), expected), arg, result_listener);
}

std::vector<double> times(std::initializer_list<double> list) { return list; }

TEST(Playback, KeepsTheRecordedPace) {
  Playback playback(1.0, 10.0);
  EXPECT_THAT(due_times(playback, {1000.0, 1000.2, 1000.7, 1001.0}),
              Times(times({0.0, 0.2, 0.7, 1.0})));
  EXPECT_EQ(playback.bad_stamps(), 0U);
}

TEST(Playback, DividesBySpeed) {
  Playback faster(4.0, 10.0);
  EXPECT_THAT(due_times(faster, {0.0, 1.0, 3.0}), Times(times({0.0, 0.25, 0.75})));
  Playback slower(0.5, 10.0);
  EXPECT_THAT(due_times(slower, {0.0, 1.0, 3.0}), Times(times({0.0, 2.0, 6.0})));
}

TEST(Playback, DoesNotWaitAtSpeedZero) {
  Playback playback(0.0, 10.0);
  EXPECT_EQ(playback.due(scan_at(0.0), 5.0), 5.0);
  EXPECT_EQ(playback.due(scan_at(9.0), 5.5), 5.5);
  EXPECT_EQ(playback.due(scan_at(std::nullopt), 5.5), 5.5);
}

TEST(Playback, UsesTheRateWithoutStamps) {
  Playback playback(2.0, 10.0);
  EXPECT_THAT(due_times(playback, {std::nullopt, std::nullopt, std::nullopt}),
              Times(times({0.0, 0.05, 0.1})));
  EXPECT_EQ(playback.bad_stamps(), 0U);
}

TEST(Playback, KeepsTheLastGoodPeriodWhereStampsJumpBackStandStillOrLeaveAGap) {
  Playback playback(1.0, 10.0);
  EXPECT_THAT(due_times(playback, {0.0, 0.5, 0.2, 0.2, 0.4, 10.5, 20.4}),
              Times(times({0.0, 0.5, 1.0, 1.5, 1.7, 1.9, 11.8})));
  EXPECT_EQ(playback.bad_stamps(), 3U);
}

TEST(Playback, SurvivesStampsThatOverflow) {
  // As in the infinite-corridor log, whose stamps were an unsigned 32 bit number of milliseconds.
  Playback playback(1.0, 5.0);
  EXPECT_THAT(due_times(playback, {-0.446, -0.913, -1.82, 4.29497e9, 4.29497e9, 4.29496e9}),
              Times(times({0.0, 0.2, 0.4, 0.6, 0.8, 1.0})));
  EXPECT_EQ(playback.bad_stamps(), 5U);
}

TEST(Playback, DoesNotCompareStampsOfTwoFiles) {
  Playback playback(1.0, 10.0);
  EXPECT_THAT(due_times(playback, {100.0, 100.25}), Times(times({0.0, 0.25})));
  RecordedScan first = scan_at(3.0);
  first.first_of_file = true;
  EXPECT_DOUBLE_EQ(playback.due(first, 5.25), 5.5);
  EXPECT_DOUBLE_EQ(playback.due(scan_at(3.5), 5.5), 6.0);
  EXPECT_EQ(playback.bad_stamps(), 0U);
}

TEST(Playback, CatchesUpWhenALittleLateAndSendsNoBurstWhenHeldUp) {
  Playback playback(1.0, 10.0);
  EXPECT_EQ(playback.due(scan_at(0.0), 5.0), 5.0);
  EXPECT_EQ(playback.due(scan_at(1.0), 6.9), 6.0);
  EXPECT_EQ(playback.due(scan_at(2.0), 6.9), 7.0);
  EXPECT_EQ(playback.due(scan_at(3.0), 9.5), 9.5);
  EXPECT_EQ(playback.due(scan_at(4.0), 9.5), 10.5);
}

}  // namespace
}  // namespace quoin::sensor_bridge
