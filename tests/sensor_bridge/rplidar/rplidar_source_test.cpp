// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/service/rplidar_source.hpp"

#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/transport/endpoint.hpp"
#include "tests/sensor_bridge/recording_source.hpp"
#include "tests/sensor_bridge/rplidar/driver/emulator_run.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using quoin::tests::source_config;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

/// Waits as the service kit does; keeps each scan.
class WaitingSource : public quoin::tests::RecordingSource {
 public:
  bool wait_until(std::chrono::steady_clock::time_point time) override {
    std::this_thread::sleep_until(time);
    return !stopping();
  }
};

TEST(RplidarSource, PublishesRevolutionsWithTrueBearingsAndTheFactsOfTheDevice) {
  const EmulatorRun emulator(quick_emulator("tcp"));
  WaitingSource source;
  source.stop_after = 3;
  open_rplidar(source_config({{"serial_port", to_text(emulator.endpoint())},
                              {"scan_frequency", "15 Hz"},
                              {"frame_id", "lidar"}}),
               "")(source);

  ASSERT_EQ(source.scans.size(), 3U);
  for (const msg::Scan& scan : source.scans) {
    EXPECT_EQ(scan.header().frame(), "lidar");
    // 1 s / 15 / 108 us, two more or less by where zero falls.
    EXPECT_NEAR(static_cast<double>(scan.ranges().size()), 617.3, 2.0);
    EXPECT_FLOAT_EQ(scan.range_max(), 40.0F);
    // The first arrivals on a machine that may be busy pull it no farther from what the device
    // declares than devices differ from that; acquisition_clock_test has the accuracy.
    EXPECT_NEAR(scan.duration(), 1.0 / 15.0, 0.03 / 15.0);
    // Clockwise from the front.
    EXPECT_NEAR(scan.bearings().front(), 0.0, 0.02);
    EXPECT_LT(scan.bearings()[100], 0.0);
    EXPECT_NEAR(scan.bearings().back(), 0.0, 0.02);
  }
  const auto between = source.scans[2].header().stamp() - source.scans[1].header().stamp();
  EXPECT_NEAR(static_cast<double>(between) * 1e-9, 1.0 / 15.0, 0.5 / 15.0);
  EXPECT_THAT(source.diagnostics, Contains(Pair("Product Name", "RPLIDAR S1M1")));
  EXPECT_THAT(source.diagnostics, Contains(Pair("Firmware Version", "1.28")));
  EXPECT_THAT(source.diagnostics, Contains(Pair("Device ID", "7E11EAF2C5E19BCFC2E19FF589C34509")));
  EXPECT_THAT(source.diagnostics, Contains(Pair("IP Address", "127.0.0.1")));
  EXPECT_THAT(source.diagnostics, Contains(Pair("Scan Mode", "DenseBoost")));
  EXPECT_THAT(source.warnings, IsEmpty());
  EXPECT_EQ(emulator.speed_at_rest(), 0.0);
}

TEST(RplidarSource, TellsOfTroubleAndOfItsEnd) {
  EmulatorRun emulator(quick_emulator("tcp"));
  WaitingSource source;
  source.stop_after = 8;
  const std::string endpoint = to_text(emulator.endpoint());
  std::jthread unplug([&] {
    while (emulator.status().state != DeviceState::scanning) std::this_thread::yield();
    emulator.apply("unplug 300ms");
  });
  open_rplidar(source_config({{"serial_port", endpoint}, {"scan_frequency", "15 Hz"}}), "")(source);
  EXPECT_EQ(source.scans.size(), 8U);
  EXPECT_THAT(source.warnings, Contains(HasSubstr("unplugged")));
  EXPECT_THAT(source.notes, Contains(HasSubstr("connected to RPLIDAR S1M1")));
  EXPECT_THAT(source.diagnostics, Contains(Pair("Recoveries from unplugged", "1")));
}

TEST(RplidarSource, WhatTheDeviceCannotDoEndsItWithTheChoiceThereIs) {
  EmulatorRun emulator(quick_emulator("tcp"));
  const auto run = [&](ParameterSettings settings) {
    WaitingSource source;
    settings.push_back({"serial_port", to_text(emulator.endpoint())});
    open_rplidar(source_config(std::move(settings)), "")(source);
  };
  const auto message = [&](const ParameterSettings& settings) -> std::string {
    try {
      run(settings);
    } catch (const runtime::SourceError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message({{"scan_mode", "Turbo"}}), HasSubstr("Standard, DenseBoost"));
  EXPECT_THAT(message({{"scan_frequency", "20 Hz"}}), HasSubstr("8..15"));
}

TEST(RplidarSource, RefusesAPortThatIsNone) {
  EXPECT_THROW((void)open_rplidar(source_config({{"serial_port", "tcp://"}}), ""), EndpointError);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
