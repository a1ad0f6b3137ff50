// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/motor.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/emulator/seconds.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr Motor::TimePoint start{std::chrono::hours(1)};

Motor::TimePoint after(double seconds) { return start + duration_of(seconds); }

TEST(Motor, RestsAtFirst) {
  const Motor motor(start);
  EXPECT_EQ(motor.turns(after(10.0)), 0.0);
  EXPECT_EQ(motor.speed(after(10.0)), 0.0);
  EXPECT_EQ(motor.stable_at(), start);
}

TEST(Motor, SpeedsUpAndSlowsDownEvenly) {
  Motor motor(start);
  motor.turn_at(10.0, 5.0, start);
  EXPECT_EQ(motor.stable_at(), after(2.0));
  EXPECT_DOUBLE_EQ(motor.speed(after(1.0)), 5.0);
  EXPECT_DOUBLE_EQ(motor.turns(after(1.0)), 2.5);
  EXPECT_DOUBLE_EQ(motor.turns(after(2.0)), 10.0);
  EXPECT_DOUBLE_EQ(motor.turns(after(3.0)), 20.0);
  motor.turn_at(0.0, 20.0, after(3.0));
  EXPECT_EQ(motor.stable_at(), after(3.5));
  EXPECT_DOUBLE_EQ(motor.speed(after(3.25)), 5.0);
  EXPECT_DOUBLE_EQ(motor.turns(after(3.5)), 22.5);
  EXPECT_DOUBLE_EQ(motor.turns(after(9.0)), 22.5);
}

TEST(Motor, ChangesItsMindOnTheWay) {
  Motor motor(start);
  motor.turn_at(10.0, 10.0, start);
  motor.turn_at(8.0, 3.0, after(0.5));  // at 5 rev/s and 1.25 rev
  EXPECT_EQ(motor.stable_at(), after(1.5));
  EXPECT_DOUBLE_EQ(motor.turns(after(1.5)), 1.25 + 6.5);
  motor.turn_at(8.0, 3.0, after(1.0));  // the same again changes nothing
  EXPECT_EQ(motor.stable_at(), after(1.5));
  EXPECT_DOUBLE_EQ(motor.turns(after(1.5)), 1.25 + 6.5);
}

TEST(Motor, MayTakeNoTime) {
  Motor motor(start);
  motor.turn_at(10.0, std::numeric_limits<double>::infinity(), start);
  EXPECT_EQ(motor.stable_at(), start);
  EXPECT_DOUBLE_EQ(motor.turns(after(1.0)), 10.0);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
