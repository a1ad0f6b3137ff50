// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/revolution_timer.hpp"

#include <gtest/gtest.h>

namespace quoin::sensor_bridge {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr RevolutionTimer::TimePoint start{std::chrono::hours(5)};

TEST(RevolutionTimer, FollowsWithoutGap) {
  RevolutionTimer timer(start, 10.0);
  auto revolution = timer.next(start);
  EXPECT_EQ(revolution.begin, start);
  EXPECT_EQ(revolution.end, start + milliseconds(100));
  revolution = timer.next(revolution.end + milliseconds(3));
  EXPECT_EQ(revolution.begin, start + milliseconds(100));
  EXPECT_EQ(revolution.end, start + milliseconds(200));
}

TEST(RevolutionTimer, DoesNotDrift) {
  RevolutionTimer timer(start, 30.0);  // a period that is no whole number of nanoseconds
  RevolutionTimer::Revolution revolution{start, start};
  for (int i = 0; i < 30 * 3600; ++i) revolution = timer.next(revolution.end);
  EXPECT_EQ(revolution.end, start + std::chrono::hours(1));
}

TEST(RevolutionTimer, CatchesUpWhenALittleLate) {
  RevolutionTimer timer(start, 10.0);
  (void)timer.next(start);
  const auto revolution = timer.next(start + milliseconds(290));
  EXPECT_EQ(revolution.begin, start + milliseconds(100));
  EXPECT_EQ(timer.next(start + milliseconds(295)).begin, start + milliseconds(200));
}

TEST(RevolutionTimer, SkipsToTheRevolutionUnderWayWhenLateByMoreThanAPeriod) {
  RevolutionTimer timer(start, 10.0);
  (void)timer.next(start);
  const auto now = start + milliseconds(1050);
  EXPECT_EQ(timer.next(now).begin, start + milliseconds(1000));
  EXPECT_EQ(timer.next(now).begin, start + milliseconds(1100));
}

}  // namespace
}  // namespace quoin::sensor_bridge
