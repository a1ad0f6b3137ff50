// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/probe.hpp"

#include <chrono>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/driver/driver_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/emulator_run.hpp"
#include "tests/sensor_bridge/rplidar/driver/scripted_transport.hpp"
#include "tests/sensor_bridge/transport/pseudo_terminal.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

ProbeReport probe_at(const Endpoint& endpoint, unsigned baud_rate = 0) {
  DriverSettings settings;
  settings.endpoint = endpoint;
  settings.baud_rate = baud_rate;
  settings.time_outs = short_time_outs();
  return probe(settings, uninterrupted());
}

TEST(Probe, FindsAnS1) {
  const EmulatorRun emulator(quick_emulator());
  const ProbeReport report = probe_at(emulator.endpoint());
  EXPECT_EQ(report.diagnosis.finding, Finding::fine);
  EXPECT_EQ(
      report.diagnosis.text,
      to_text(emulator.endpoint()) +
          ": S1M1, firmware 1.28, serial number 7E11EAF2C5E19BCFC2E19FF589C34509, 256000 baud");
  EXPECT_FALSE(report.was_sending);
  ASSERT_TRUE(report.facts);
  EXPECT_EQ(report.facts->modes.size(), 2u);
}

TEST(Probe, TellsTheRightBaudRate) {
  EmulatorSettings device = quick_emulator();
  device.baud_rate = 115200;
  const EmulatorRun emulator(device);
  const ProbeReport report = probe_at(emulator.endpoint(), 256000);
  EXPECT_EQ(report.diagnosis.finding, Finding::other_baud_rate);
  EXPECT_THAT(report.diagnosis.advice, HasSubstr("115200"));
}

TEST(Probe, LeavesADeviceThatWasScanningIdle) {
  const EmulatorRun emulator(quick_emulator());
  {
    const auto transport = open_transport(emulator.endpoint(), 256000, 1s);
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    transport->write(express_scan_request(1).bytes(), deadline);
    std::uint8_t bytes[512];
    for (std::size_t size = 0; size < 2000;) size += transport->read(bytes, deadline);
  }
  const ProbeReport report = probe_at(emulator.endpoint());
  EXPECT_EQ(report.diagnosis.finding, Finding::fine);
  EXPECT_TRUE(report.was_sending);
  EXPECT_EQ(emulator.speed_at_rest(), 0.0);
  EXPECT_EQ(emulator.status().state, DeviceState::idle);
}

TEST(Probe, TellsOfAProtectionStop) {
  EmulatorSettings device = quick_emulator();
  device.faults = "health_error=1";
  const EmulatorRun emulator(device);
  const ProbeReport report = probe_at(emulator.endpoint());
  EXPECT_EQ(report.diagnosis.finding, Finding::protection_stop);
  EXPECT_THAT(report.diagnosis.text, HasSubstr("S1M1"));
}

TEST(Probe, TellsOfAnUnknownModel) {
  EmulatorSettings device = quick_emulator();
  device.faults = "unknown_model";
  const EmulatorRun emulator(device);
  const ProbeReport report = probe_at(emulator.endpoint());
  EXPECT_EQ(report.diagnosis.finding, Finding::unknown_model) << to_text(report.diagnosis);
}

TEST(Probe, TellsThatNobodyIsThere) {
  const quoin::tests::PseudoTerminal terminal;
  const ProbeReport report = probe_at(parse_endpoint(terminal.path()));
  EXPECT_EQ(report.diagnosis.finding, Finding::no_bytes);
  EXPECT_THAT(to_text(report.diagnosis),
              AllOf(StartsWith(terminal.path() + ": no answer"), HasSubstr("power")));
  EXPECT_FALSE(report.facts);
}

TEST(Probe, TellsThatThereIsNoPort) {
  const ProbeReport report = probe_at(parse_endpoint("/dev/ttyUSB_none"));
  EXPECT_EQ(report.diagnosis.finding, Finding::no_such_port);
  EXPECT_THAT(report.diagnosis.advice, HasSubstr("cable"));
}

TEST(Findings, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (int finding = 0; finding < finding_count; ++finding) {
    names.insert(name_of(static_cast<Finding>(finding)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(finding_count));
  EXPECT_EQ(name_of(Finding::fine), "fine");
  EXPECT_EQ(name_of(Finding::no_bytes), "no-bytes");
  EXPECT_EQ(name_of(Finding::no_revolution), "no-revolution");
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
