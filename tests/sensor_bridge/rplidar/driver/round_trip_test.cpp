// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/driver_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/emulator_run.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

DriverSettings settings_for(const EmulatorRun& emulator) {
  DriverSettings settings;
  settings.endpoint = emulator.endpoint();
  return settings;
}

class OverEach : public ::testing::TestWithParam<const char*> {};

TEST_P(OverEach, AnS1MeasuresAsSoonAsItIsFound) {
  EmulatorSettings device = quick_emulator();
  device.connection = GetParam();
  const EmulatorRun emulator(device);
  DriverRun driver(settings_for(emulator));
  ASSERT_TRUE(driver.wait_for_revolutions(5));
  driver.stop();

  const DriverRecord record = driver.record();
  EXPECT_THAT(record.problems, IsEmpty());
  EXPECT_EQ(record.counts.connections, 1u);
  EXPECT_EQ(record.counts.checksum_errors, 0u);
  EXPECT_EQ(record.counts.skipped_bytes, 0u);
  EXPECT_EQ(record.counts.lost_samples, 0u);
  EXPECT_EQ(record.facts->baud_rate, GetParam() == std::string("pty") ? 256000u : 0u);
  EXPECT_EQ(model_text(record.facts->info), "S1M1");
  EXPECT_EQ(serial_number_text(record.facts->info), "7E11EAF2C5E19BCFC2E19FF589C34509");
  EXPECT_EQ(record.facts->speed, (SpeedRange{480, 600, 900}));
  EXPECT_EQ(record.plan->mode.name, "DenseBoost");
  EXPECT_EQ(record.plan->speed, 600);
  EXPECT_EQ(record.mode->format, SampleFormat::dense);
  EXPECT_NEAR(static_cast<double>(record.last_revolution.angle_q16.size()), 926, 2);
  EXPECT_THAT(record.states, ElementsAre(DriverState::connecting, DriverState::starting,
                                         DriverState::measuring, DriverState::stopped));
  EXPECT_EQ(emulator.speed_at_rest(), 0.0);
  EXPECT_EQ(emulator.status().state, DeviceState::idle);
}

INSTANTIATE_TEST_SUITE_P(Connection, OverEach, ::testing::Values("pty", "tcp", "udp"),
                         [](const auto& test) { return std::string(test.param); });

class InEach : public ::testing::TestWithParam<const char*> {};

TEST_P(InEach, ModeTheSameRoomIsMeasured) {
  EmulatorSettings device = quick_emulator();
  device.all_formats = true;
  device.connection = "udp";  // carries more than the line of an S1 does
  const EmulatorRun emulator(device);
  DriverSettings settings = settings_for(emulator);
  settings.scan_mode = GetParam();
  DriverRun driver(settings);
  ASSERT_TRUE(driver.wait_for_revolutions(3));
  driver.stop();

  const DriverRecord record = driver.record();
  EXPECT_THAT(record.problems, IsEmpty());
  EXPECT_EQ(record.mode->name, record.plan->mode.name);
  const Revolution& revolution = record.last_revolution;
  EXPECT_NEAR(static_cast<double>(revolution.angle_q16.size()) * record.mode->sample_period, 0.1,
              0.003);
  // The walls of the room are nearer than 20 m on every side.
  for (const std::uint32_t distance : revolution.distance_q2) EXPECT_LT(distance, 4 * 20000u);
  EXPECT_EQ(emulator.speed_at_rest(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Mode, InEach,
                         ::testing::Values("Standard", "DenseBoost", "Express", "HQ", "Boost",
                                           "UltraDense"),
                         [](const auto& test) { return std::string(test.param); });

TEST(RoundTrip, TheMotorTurnsAsFastAsItIsTold) {
  const EmulatorRun emulator(quick_emulator());
  DriverSettings settings = settings_for(emulator);
  settings.scan_frequency = 15.0;
  DriverRun driver(settings);
  ASSERT_TRUE(driver.wait_for_revolutions(4));
  EXPECT_EQ(driver.record().plan->speed, 900);
  EXPECT_NEAR(static_cast<double>(driver.record().last_revolution.angle_q16.size()), 617, 2);
  EXPECT_NEAR(emulator.status().motor_speed, 15.0, 0.01);
  driver.stop();
  EXPECT_THAT(driver.record().problems, IsEmpty());
}

TEST(RoundTrip, ADeviceThatWasLeftScanningIsTakenOver) {
  const EmulatorRun emulator(quick_emulator());
  const DriverSettings settings = settings_for(emulator);
  {
    // As a driver that is killed leaves it.
    const auto transport = open_transport(settings.endpoint, 256000, std::chrono::seconds(1));
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    transport->write(motor_speed_request(600).bytes(), deadline);
    transport->write(express_scan_request(1).bytes(), deadline);
    std::uint8_t bytes[512];
    for (std::size_t size = 0; size < 2000;) size += transport->read(bytes, deadline);
  }
  DriverRun driver(settings);
  ASSERT_TRUE(driver.wait_for_revolutions(2));
  driver.stop();
  EXPECT_EQ(driver.record().counts.connections, 1u);
  EXPECT_THAT(driver.record().problems, IsEmpty());
  EXPECT_EQ(emulator.speed_at_rest(), 0.0);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
