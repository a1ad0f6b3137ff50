// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <csignal>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/harness/deployment.hpp"
#include "tests/sensor_bridge/rplidar/driver/emulator_run.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using sensor_bridge::rplidar::EmulatorRun;
using tests::CornerRecorder;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

std::string diagnostic(const msg::ServiceStatus& status, const std::string& name) {
  const auto& all = status.diagnostics();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.name() == name; });
  return found == all.end() ? "" : found->value();
}

TEST(Rplidar, AnEmulatedDeviceIsSeenAsCornersAndFoundAgainAfterItWasUnplugged) {
  const TestDeployment deployment(R"(
  - name: device
    kind: rplidar_emulator
    parameters: {link: device.tty, spin_up_time: 0.2 s, reset_time: 0.2 s}
  - {name: front, kind: rplidar, parameters: {serial_port: ./device.tty, scan_frequency: 15 Hz}}
  - {name: walls, kind: segmentation, input: front}
  - {name: lines, kind: line_fitting, input: walls}
  - {name: corners, kind: corner_estimation, input: lines}
)");
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder recorder(participant, deployment, "corners");
  StatusRecorder status(participant, deployment);
  Process corners = deployment.start("corners", 1);
  Process lines = deployment.start("lines");
  Process walls = deployment.start("walls");
  Process front = deployment.start("front");  // waits for the device
  Process device = deployment.start("device");
  ASSERT_TRUE(recorder.wait_for(10)) << front.errors();

  device.signal(SIGKILL);  // the terminal's other end is gone, as of a pulled plug
  ASSERT_TRUE(device.wait(10s));
  ASSERT_TRUE(status.wait_for("front", [](const auto& s) { return !s.detail().empty(); }));
  EXPECT_THAT(status.latest("front").detail(), testing::HasSubstr("device.tty"));
  const std::size_t before = recorder.poll();
  Process again = deployment.start("device");
  ASSERT_TRUE(recorder.wait_for(before + 10)) << front.errors();
  ASSERT_TRUE(status.wait_for("front", [](const auto& s) {
    return diagnostic(s, "Connections") == "2" && s.detail().empty();
  }));
  const msg::ServiceStatus facts = status.latest("front");
  EXPECT_EQ(diagnostic(facts, "Product Name"), "RPLIDAR S1M1");
  EXPECT_EQ(diagnostic(facts, "Device ID"), "7E11EAF2C5E19BCFC2E19FF589C34509");
  EXPECT_EQ(diagnostic(facts, "Serial Baud"), "256000");
  EXPECT_EQ(diagnostic(facts, "Lost Samples"), "0");

  front.signal(SIGTERM);
  ASSERT_EQ(front.wait(10s), 0) << front.errors();
  ASSERT_TRUE(status.wait_for(
      "front", [](const auto& s) { return s.state() == msg::ServiceState::STATE_STOPPED; }));
  // The motor does not stay on.
  EXPECT_TRUE(status.wait_for(
      "device", [](const auto& s) { return diagnostic(s, "Device State") == "idle"; }));

  const std::uint64_t published = status.latest("front").published();
  EXPECT_TRUE(tests::eventually([&] { return recorder.poll() == published; }));
  EXPECT_THAT(recorder.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_EQ(recorder.accounting().duplicates(), 0U);
  std::size_t seen = 0;
  for (const msg::Corners& message : recorder.messages()) seen += message.corners().size();
  // The room has more corners than that in view from everywhere.
  EXPECT_GT(seen, 8 * recorder.messages().size());
}

TEST(Rplidar, WhatTheDeviceCannotDoEndsTheBridgeAsAnInputError) {
  const EmulatorRun emulator(sensor_bridge::rplidar::quick_emulator("tcp"));
  const TestDeployment deployment("  - {name: front, kind: rplidar, parameters: {serial_port: \"" +
                                  to_text(emulator.endpoint()) + "\", scan_mode: Turbo}}\n");
  Process front = deployment.start("front");
  EXPECT_EQ(front.wait(20s), 3);
  EXPECT_THAT(front.errors(), testing::HasSubstr("choose one of: Standard, DenseBoost"));
}

class LidarCommand : public testing::Test {
 protected:
  /// What `quoin lidar COMMAND ENDPOINT --json` prints.
  nlohmann::json run(const std::string& command, int exit_code) {
    Process process("quoin", {"lidar", command, to_text(emulator_.endpoint()), "--json"},
                    directory_.path());
    EXPECT_EQ(process.wait(60s), exit_code) << process.errors();
    return nlohmann::json::parse(process.output());
  }

  tests::TemporaryFolder directory_;
  EmulatorRun emulator_{sensor_bridge::rplidar::quick_emulator("tcp")};
};

TEST_F(LidarCommand, ProbeTellsWhoItIsAndHowFastItMeasures) {
  const nlohmann::json report = run("probe", 0);
  ASSERT_EQ(report["devices"].size(), 1U);
  const nlohmann::json& device = report["devices"][0];
  EXPECT_EQ(device["finding"], "fine");
  EXPECT_EQ(device["model"], "S1M1");
  EXPECT_EQ(device["firmware"], "1.28");
  EXPECT_EQ(device["serial_number"], "7E11EAF2C5E19BCFC2E19FF589C34509");
  EXPECT_EQ(device["health"], "good");
  EXPECT_EQ(device["scan_modes"].size(), 2U);
  EXPECT_NEAR(device["measured"]["scan_frequency_hz"].get<double>(), 10.0, 0.1);
  EXPECT_NEAR(device["measured"]["sample_rate_hz"].get<double>(), 1e6 / 108, 50.0);
  EXPECT_EQ(device["measured"]["lost_samples"], 0);
  EXPECT_EQ(emulator_.speed_at_rest(), 0.0);
}

TEST_F(LidarCommand, DoctorFindsNothingWrongWithAGoodDevice) {
  const nlohmann::json report = run("doctor", 0);
  EXPECT_EQ(report["healthy"], true);
  EXPECT_EQ(report["devices"][0]["checks"].size(), 6U);
}

TEST_F(LidarCommand, DoctorSaysWhatIsWrongAndWhatToDo) {
  const auto bad_check = [this](const std::string& fault) {
    emulator_.clear_faults();
    emulator_.apply(fault);
    const nlohmann::json report = run("doctor", 1);
    EXPECT_EQ(report["healthy"], false) << fault;
    for (const nlohmann::json& check : report["devices"][0]["checks"]) {
      if (check["verdict"] == "ok") continue;
      EXPECT_NE(check["advice"], "") << fault;
      return check["check"].get<std::string>() + ": " + check["text"].get<std::string>();
    }
    return std::string("nothing");
  };
  EXPECT_THAT(bad_check("silence"), testing::HasSubstr("not a byte arrives"));
  EXPECT_THAT(bad_check("wrong_checksums=0.2"), testing::StartsWith("samples: "));
  EXPECT_THAT(bad_check("speed=13"), testing::StartsWith("rotation: 13"));
  EXPECT_THAT(bad_check("unknown_model"), testing::StartsWith("connection: "));
  EXPECT_THAT(bad_check("health_error"), testing::StartsWith("health: protection stop"));
}

}  // namespace
}  // namespace quoin
