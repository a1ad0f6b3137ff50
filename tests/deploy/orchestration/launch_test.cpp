// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/launch.hpp"

#include <algorithm>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/kinds/kinds.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {

const char* process_program() { return "launch_test"; }  // which is there

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

int no_observers(const ServiceConfig&) { return 0; }

std::vector<ProcessPlan> plans(const Deployment& deployment, const std::string& host = "") {
  return process_plans(deployment, host, no_observers);
}

const ProcessPlan& named(const std::vector<ProcessPlan>& plans, std::string_view name) {
  return *std::ranges::find(plans, name, &ProcessPlan::name);
}

Deployment robot() {
  return deployment({service("front", lidar), service("fit", fitter, {{"scan", "front"}}),
                     service("map", mapper, {{"lines", "fit"}, {"odometry", "front"}}, "plain"),
                     service("log", tape, {{"", "front"}})});
}

TEST(Launch, EachServiceIsAProcessOfItsKindsProgram) {
  const auto all = plans(robot());
  ASSERT_EQ(all.size(), 4U);
  const ProcessPlan& fit = named(all, "fit");
  EXPECT_EQ(fit.program, program_folder() / "launch_test");
  EXPECT_THAT(fit.arguments, ElementsAre("--service", "fit", "--deployment", "/robots/robot.yaml"));
  EXPECT_TRUE(fit.restart);
  EXPECT_FALSE(fit.source);
  EXPECT_TRUE(named(all, "front").source);
}

TEST(Launch, LevelsFollowTheLongestWayAndObserversComeLast) {
  const auto all = plans(robot());
  EXPECT_EQ(named(all, "front").level, 0);
  EXPECT_EQ(named(all, "fit").level, 1);
  EXPECT_EQ(named(all, "map").level, 2);
  EXPECT_GT(named(all, "log").level, 2);
}

TEST(Launch, ADeviceOutlivesAllOthers) {
  Deployment with_device = robot();
  with_device.services.insert(with_device.services.begin(), service("emulator", device));
  const auto all = plans(with_device);
  for (const ProcessPlan& plan : all) {
    if (plan.name == "emulator") continue;
    EXPECT_GT(named(all, "emulator").level, plan.level) << plan.name;
  }
}

TEST(Launch, ObserversOutsideAreWaitedFor) {
  const auto all = process_plans(
      robot(), "", [](const ServiceConfig& config) { return config.name == "map" ? 2 : 0; });
  EXPECT_THAT(named(all, "map").arguments,
              ElementsAre("--service", "map", "--deployment", "/robots/robot.yaml", "--observers",
                          "map=2"));
  EXPECT_EQ(named(all, "fit").arguments.size(), 4U);
}

TEST(Launch, ServicesReadTheCopyButNameTheFile) {
  const auto all = process_plans(robot(), "", no_observers, "/proc/1/fd/7");
  EXPECT_THAT(named(all, "fit").arguments,
              ElementsAre("--service", "fit", "--deployment", "/proc/1/fd/7", "--deployment-name",
                          "/robots/robot.yaml"));
}

TEST(Launch, AStrangersProgramIsStartedAsItIsWritten) {
  const auto all = plans(deployment(
      {stranger("camera", "rt/scan", "best_effort", {"/opt/camera", "--fast"}),
       stranger("elsewhere", "rt/other"), service("fit", fitter, {{"scan", "camera"}})}));
  ASSERT_EQ(all.size(), 2U) << "the other stranger is nobody's process";
  EXPECT_EQ(named(all, "camera").program, "/opt/camera");
  EXPECT_THAT(named(all, "camera").arguments, ElementsAre("--fast"));
  EXPECT_EQ(named(all, "fit").level, 1);
}

TEST(Launch, OnlyTheShareOfTheHostIsStarted) {
  Deployment two_hosts = robot();
  for (ServiceConfig& each : two_hosts.services)
    each.host = each.name == "front" ? "base" : "cabin";
  EXPECT_EQ(plans(two_hosts, "base").size(), 1U);
  const auto cabin = plans(two_hosts, "cabin");
  ASSERT_EQ(cabin.size(), 3U);
  EXPECT_EQ(named(cabin, "fit").level, 1) << "as in the whole deployment";
}

TEST(Launch, InstancesAreStartedUnderTheirLabels) {
  Deployment standby = robot();
  standby.services[1].strength = 2;
  const auto all = plans(standby);
  EXPECT_EQ(named(all, "fit@2").arguments.at(1), "fit@2");
}

TEST(Launch, ServicesOfOneProcessAreStartedByOneProgram) {
  Deployment composed = robot();
  for (ServiceConfig& each : composed.services) {
    if (each.name == "fit" || each.name == "map") each.process = "perception";
  }
  const auto all = process_plans(
      composed, "", [](const ServiceConfig& config) { return config.name == "map" ? 1 : 0; });
  ASSERT_EQ(all.size(), 3U);
  const ProcessPlan& perception = named(all, "perception");
  EXPECT_THAT(perception.services, ElementsAre("fit", "map"));
  EXPECT_EQ(perception.program, program_folder() / process_program());
  EXPECT_EQ(perception.level, 1) << "of the first of them";
  EXPECT_THAT(perception.arguments, ElementsAre("--process", "perception", "--deployment",
                                                "/robots/robot.yaml", "--observers", "map=1"));
  EXPECT_FALSE(perception.source);
  EXPECT_TRUE(perception.runs("map"));
  EXPECT_FALSE(perception.runs("front"));
}

TEST(Launch, AMissingProgramIsNamedBeforeAnythingRuns) {
  try {
    (void)plans(deployment({service("front", missing)}));
    FAIL() << "the program is not there";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no-such-program"));
    EXPECT_THAT(error.what(), HasSubstr("'front'"));
  }
}

}  // namespace
}  // namespace quoin::deploy
