// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// A scan source that is no service of Quoin: a program of Cyclone DDS that writes best effort, on a
// topic of its own, with or without our header.
#include <csignal>
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/topics/header.hpp"
#include "tests/integration/harness/test_tool.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::TestRun;

class External : public testing::Test {
 protected:
  void SetUp() override {
    const std::string configuration = QUOIN_CYCLONE_CONFIGURATION;  // empty when it is not there
    if (configuration.empty()) {
      GTEST_SKIP() << "built without Cyclone DDS; tests/packages.txt names its packages";
    }
    setenv("CYCLONEDDS_URI", ("file://" + configuration).c_str(), 1);
  }

  static std::string topic() { return tests::test_namespace() + "/stranger"; }

  /// The service "lidar" of the deployment. `entries`: type and QoS; `task`: what the program is
  /// told behind domain and topic.
  static std::string lidar(const std::string& entries, const std::string& task) {
    return "  - {name: lidar, kind: external, topic: " + topic() + ", " + entries + ",\n" +
           "     program: [" QUOIN_BIN_DIR "/cyclone_source, \"" +
           std::to_string(tests::test_domain()) + "\", " + topic() + ", " + task + "]}\n";
  }
};

constexpr auto chain =
    "  - {name: walls, kind: segmentation, input: lidar}\n"
    "  - {name: lines, kind: line_fitting, input: walls}\n"
    "  - {name: corners, kind: corner_estimation, input: lines}\n"
    "  - {name: tape, kind: test_observer, inputs: all}\n";

TEST_F(External, IsNumberedByDdsAndItsLossesAreCountedOnTheLink) {
  TestRun run(lidar("type: scan, qos: best_effort", R"("100000", "2", "50", best_effort)") + chain);
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(50)) << run.log();
  const msg::Header& header = corners.messages().back().header();
  EXPECT_EQ(topics::source(header), "lidar");
  ASSERT_EQ(header.trace().size(), 4U);
  EXPECT_EQ(header.trace().front().service(), "lidar");
  EXPECT_GE(corners.messages().back().corners().size(), 4U) << "a room has four corners";

  // What neither the socket nor the history of a reader that stands still can hold is lost.
  const pid_t walls = run.pid_of("walls");
  const auto seen = topics::sequence_number(header);
  ASSERT_EQ(kill(walls, SIGSTOP), 0);
  ASSERT_TRUE(run.status().wait_for("tape", [&](const auto& s) {
    return s.inputs().size() > 0 && s.inputs()[0].received() > seen + 100;
  })) << run.log();
  ASSERT_EQ(kill(walls, SIGCONT), 0);
  ASSERT_TRUE(tests::eventually([&] {
    corners.poll();
    return topics::sequence_number(corners.messages().back().header()) > seen + 200;
  }));
  ASSERT_TRUE(run.status().wait_for(
      "walls", [](const auto& s) { return s.inputs()[0].lost() > 0 && s.losses().size() == 1; }));
  EXPECT_EQ(run.latest("walls").losses().front().cause(), "link");

  // One that is started again goes on where DDS is.
  ASSERT_TRUE(run.kill_and_wait("walls")) << run.log();
  ASSERT_TRUE(run.goes_on("corners", 20));
  corners.poll();
  EXPECT_EQ(corners.accounting().duplicates(), 0U);
  const auto& accounting = corners.accounting();
  const auto last = topics::sequence_number(corners.messages().back().header());
  EXPECT_EQ(accounting.received() + accounting.lost(), last + 1 - *accounting.first_sequence());

  const json figures = run.end();
  EXPECT_EQ(figures["services"].contains("lidar"), false);
  const json& end = figures["ends"]["corners"];
  EXPECT_GT(end["lost_by_stage"]["walls"], 0) << end;
  EXPECT_EQ(end["scans_delivered"].get<int>() + end["scans_lost"].get<int>(),
            end["scans_expected"].get<int>());
  EXPECT_GT(end["scans_expected"], last) << end;
}

TEST_F(External, MayNumberItsScansItselfAndBeStartedAgain) {
  TestRun run(lidar("type: scan, qos: sensor", R"("40", "1", "50", sensor, lidar)") +
              "  - {name: walls, kind: segmentation, input: lidar}\n"
              "  - {name: lines, kind: line_fitting, input: walls}\n"
              "  - {name: corners, kind: corner_estimation, input: lines}\n");
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(40)) << run.log();
  EXPECT_EQ(topics::sequence_number(corners.messages().back().header()), 39U);
  EXPECT_THAT(corners.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_TRUE(tests::eventually([&] {
    return run.log().find("lidar: ended by itself; not started again") != std::string::npos;
  })) << run.log();
  const json end = run.end()["ends"]["corners"];
  EXPECT_EQ(end["scans_delivered"], 40) << end;
  EXPECT_EQ(end["scans_lost"], 0) << end;
}

TEST_F(External, OfAnotherTypeIsNamedWithBothTypes) {
  TestRun run(lidar("type: lines, qos: best_effort", R"("100000", "1", "50", best_effort)") +
              "  - {name: corners, kind: corner_estimation, input: lidar}\n");
  run.up();
  ASSERT_TRUE(run.status().wait_for("corners", [](const auto& s) {
    return !s.incompatible_qos().empty();
  })) << run.log();
  EXPECT_THAT(run.latest("corners").incompatible_qos().front(),
              AllOf(HasSubstr(topic() + ": type: "), HasSubstr("offers quoin::msg::Scan"),
                    HasSubstr("corners requests quoin::msg::Lines")));
  (void)run.end();
}

TEST_F(External, OfAnotherReliabilityIsNamedWithBothSides) {
  TestRun run(lidar("type: scan, qos: sensor", R"("100000", "1", "50", best_effort)") +
              "  - {name: walls, kind: segmentation, input: lidar}\n");
  run.up();
  ASSERT_TRUE(run.status().wait_for("walls", [](const auto& s) {
    return !s.incompatible_qos().empty();
  })) << run.log();
  EXPECT_THAT(run.latest("walls").incompatible_qos().front(),
              AllOf(HasSubstr(topic() + ": reliability: "), HasSubstr("offers best effort"),
                    HasSubstr("walls requests reliable")));
  (void)run.end();
}

}  // namespace
}  // namespace quoin
