// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/stop_motor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/scripted_transport.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::SizeIs;

TEST(StopMotor, EndsTheScanThenIdlesTheMotor) {
  Script script;
  ScriptedTransport transport(script);
  stop_motor(transport, MotorControl::speed);
  EXPECT_THAT(script.commands, ElementsAre(Command::stop, Command::motor_speed));
  EXPECT_THAT(script.requests[1].payload(), ElementsAre(0, 0));
  EXPECT_EQ(script.motor_held, std::nullopt);
}

TEST(StopMotor, UsesWhatDrivesTheMotor) {
  const auto stopped = [](std::optional<MotorControl> control) {
    Script script;
    ScriptedTransport transport(script);
    stop_motor(transport, control);
    return script;
  };
  const Script line = stopped(MotorControl::line);
  EXPECT_THAT(line.commands, ElementsAre(Command::stop));
  EXPECT_EQ(line.motor_held, true);
  const Script board = stopped(MotorControl::pwm);
  EXPECT_THAT(board.commands, ElementsAre(Command::stop, Command::motor_pwm));
  EXPECT_THAT(board.requests[1].payload(), ElementsAre(0, 0));
  EXPECT_EQ(board.motor_held, std::nullopt);
  EXPECT_THAT(stopped(MotorControl::none).commands, ElementsAre(Command::stop));
  EXPECT_THAT(stopped(std::nullopt).commands,
              ElementsAre(Command::stop, Command::motor_speed, Command::motor_pwm));
}

TEST(StopMotor, SaysItAgainToADeviceThatHasMissedIt) {
  Script script;
  script.stream = [&script] { return script.commands.size() < 6 ? Bytes(84, 0x55) : Bytes(); };
  ScriptedTransport transport(script);
  stop_motor(transport, MotorControl::speed);
  EXPECT_THAT(script.commands, SizeIs(6));
}

TEST(StopMotor, GivesUpOnADeviceThatIsDeaf) {
  Script script;
  script.stream = [] { return Bytes(84, 0x55); };
  ScriptedTransport transport(script);
  stop_motor(transport, MotorControl::speed);
  EXPECT_THAT(script.commands, SizeIs(Le(62)));
}

TEST(StopMotor, IsSilentWhereNobodyIsThere) {
  Script script;
  script.failure = TransportError(TransportError::Kind::closed, "gone");
  ScriptedTransport transport(script);
  stop_motor(transport, MotorControl::speed);
  EXPECT_THAT(script.commands, IsEmpty());
}

TEST(MotorGuard, StopsTheMotorOnceAndOnlyWhenArmed) {
  Script script;
  { const MotorGuard guard(std::make_unique<ScriptedTransport>(script)); }
  EXPECT_THAT(script.commands, IsEmpty());
  {
    MotorGuard guard(std::make_unique<ScriptedTransport>(script));
    guard.arm(true);
    const MotorGuard other(std::move(guard));
  }
  EXPECT_THAT(script.commands,
              ElementsAre(Command::stop, Command::motor_speed, Command::motor_pwm));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
