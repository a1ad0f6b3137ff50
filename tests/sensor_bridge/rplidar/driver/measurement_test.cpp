// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/measurement.hpp"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/emulator_run.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;

bool sleep_until(std::chrono::steady_clock::time_point time) {
  std::this_thread::sleep_until(time);
  return true;
}

DriverSettings settings_for(const EmulatorRun& emulator) {
  DriverSettings settings;
  settings.endpoint = emulator.endpoint();
  return settings;
}

TEST(Measure, TellsTheRatesAndLetsTheMotorStop) {
  const EmulatorRun emulator(quick_emulator("tcp"));
  DriverSettings settings = settings_for(emulator);
  settings.scan_frequency = 12.0;
  const Measurement measurement = measure(settings, 4, 20s, sleep_until);
  EXPECT_GE(measurement.revolutions, 4U);
  EXPECT_NEAR(measurement.frequency, 12.0, 0.05);
  EXPECT_NEAR(measurement.sample_rate, 1e6 / 108, 20.0);
  EXPECT_EQ(measurement.return_share, 1.0);
  EXPECT_EQ(measurement.counts.lost_samples, 0U);
  ASSERT_TRUE(measurement.plan.has_value());
  EXPECT_EQ(measurement.plan->speed, 720);
  EXPECT_THAT(measurement.problems, IsEmpty());
  EXPECT_EQ(emulator.speed_at_rest(), 0.0);
}

TEST(Measure, EndsInTimeAndTellsWhy) {
  EmulatorRun emulator(quick_emulator("tcp"));
  emulator.apply("silence");
  const Measurement silent = measure(settings_for(emulator), 4, 2500ms, sleep_until);
  EXPECT_EQ(silent.revolutions, 0U);
  EXPECT_EQ(silent.frequency, 0.0);
  EXPECT_THAT(silent.problems, ElementsAre(Field(&Diagnosis::finding, Finding::no_bytes)));

  emulator.clear_faults();
  DriverSettings settings = settings_for(emulator);
  settings.scan_mode = "Turbo";
  EXPECT_THAT(measure(settings, 4, 20s, sleep_until).problems,
              ElementsAre(Field(&Diagnosis::finding, Finding::unknown_scan_mode)));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
