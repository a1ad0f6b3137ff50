// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/orchestration/plan.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using Ports = std::vector<std::pair<std::string, std::string>>;

/// Two sensors, a fitter and a mapper that reads it and the odometry of the first.
Deployment robot(const std::string& method = "plain",
                 const Ports& ports = {{"lines", "fit"}, {"odometry", "front"}}) {
  return deployment({service("front", lidar), service("rear", lidar),
                     service("fit", fitter, {{"scan", "front"}}),
                     service("map", mapper, ports, method)});
}

Change change_of(const std::string& name, const Deployment& running, const Deployment& wanted) {
  return plan_changes(running, wanted).of(name);
}

TEST(PlanOfPorts, AnotherServiceBehindOnePortReplacesTheReaderAlone) {
  const Deployment wanted = robot("plain", {{"lines", "fit"}, {"odometry", "rear"}});
  const Plan plan = plan_changes(robot(), wanted);
  EXPECT_EQ(plan.of("map").action, ChangeAction::replace);
  EXPECT_THAT(plan.of("map").detail, HasSubstr("odometry=front"));
  EXPECT_THAT(plan.of("map").detail, HasSubstr("odometry=rear"));
  EXPECT_TRUE(plan.of("map").same_scans) << "those of the lines";
  for (const char* other : {"front", "rear", "fit"}) {
    EXPECT_EQ(plan.of(other).action, ChangeAction::keep) << other;
  }
}

TEST(PlanOfPorts, ThePortThatIsHandledEachDecidesWhetherTheScansAreTheSame) {
  Deployment wanted = robot();
  wanted.services[2] = service("fit", fitter, {{"scan", "rear"}});
  const Plan plan = plan_changes(robot(), wanted);
  EXPECT_FALSE(plan.of("fit").same_scans);
  EXPECT_EQ(plan.of("map").action, ChangeAction::keep) << "it reads the same topics";
}

TEST(PlanOfPorts, TheQosOfAPortReplacesWriterAndReader) {
  Deployment wanted = robot();
  wanted.services[0].outputs[1].qos = "lossless";  // the odometry
  const Plan plan = plan_changes(robot(), wanted);
  EXPECT_EQ(plan.of("front").action, ChangeAction::replace);
  EXPECT_EQ(plan.of("map").action, ChangeAction::replace);
  EXPECT_EQ(plan.of("map").detail, "qos of front feature -> lossless");
  EXPECT_EQ(plan.of("fit").action, ChangeAction::keep) << "it reads the other output";
  EXPECT_EQ(plan.of("rear").action, ChangeAction::keep);
}

TEST(PlanOfPorts, AnObserverIsReplacedWhenWhatItReadsChanges) {
  Deployment running = robot();
  running.services.push_back(service("log", tape, {{"", "fit"}}));
  Deployment wanted = robot();
  wanted.services.push_back(service("log", tape, {{"", "fit"}, {"", "map"}}));
  const Change change = change_of("log", running, wanted);
  EXPECT_EQ(change.action, ChangeAction::replace);
  EXPECT_EQ(change.detail, "input fit -> fit, map");
}

TEST(PlanOfState, GoesOnWhereTheFormIsTheSame) {
  const Change change = change_of("map", robot("lines"), robot("fast_lines"));
  EXPECT_EQ(change.action, ChangeAction::swap);
  EXPECT_THAT(change.detail, Not(HasSubstr("state")));
}

TEST(PlanOfState, SaysWhatWouldBeDropped) {
  for (const char* method : {"grid", "plain"}) {
    const Change change = change_of("map", robot("lines"), robot(method));
    EXPECT_EQ(change.action, ChangeAction::swap);
    EXPECT_THAT(change.detail, HasSubstr("drops its state (line_map/1)"));
  }
  EXPECT_THAT(change_of("map", robot("plain"), robot("grid")).detail, Not(HasSubstr("state")))
      << "there was none";
}

TEST(PlanOfState, AReplacementCarriesItOverOrSaysThatItDoesNot) {
  const Ports rear{{"lines", "fit"}, {"odometry", "rear"}};
  const Change same = change_of("map", robot("lines"), robot("fast_lines", rear));
  EXPECT_EQ(same.action, ChangeAction::replace);
  EXPECT_THAT(same.detail, Not(HasSubstr("state")));
  const Change other = change_of("map", robot("lines"), robot("grid", rear));
  EXPECT_EQ(other.action, ChangeAction::replace);
  EXPECT_THAT(other.detail, HasSubstr("drops its state (line_map/1)"));
}

TEST(PlanOfStrangers, WhoRunsElsewhereIsNoPartOfIt) {
  const Deployment running =
      deployment({stranger("camera", "rt/scan"), service("fit", fitter, {{"scan", "camera"}})});
  const Plan plan = plan_changes(running, running);
  ASSERT_EQ(plan.changes.size(), 1U);
  EXPECT_EQ(plan.changes[0].service, "fit");
}

TEST(PlanOfStrangers, AnotherTopicOrQosReplacesTheReader) {
  const auto with = [](const ServiceConfig& camera) {
    return deployment({camera, service("fit", fitter, {{"scan", "camera"}})});
  };
  const Deployment running = with(stranger("camera", "rt/scan"));
  EXPECT_EQ(to_text(change_of("fit", running, with(stranger("camera", "rt/other")))),
            "replace fit: topic of camera rt/scan -> rt/other");
  EXPECT_EQ(to_text(change_of("fit", running, with(stranger("camera", "rt/scan", "sensor")))),
            "replace fit: qos of camera best_effort -> sensor");
}

TEST(PlanOfStrangers, TheirProgramsAreStartedReplacedAndStopped) {
  const Deployment none = deployment({stranger("camera", "rt/scan")});
  const Deployment one =
      deployment({stranger("camera", "rt/scan", "best_effort", {"/opt/camera", "--fast"})});
  const Deployment other =
      deployment({stranger("camera", "rt/scan", "best_effort", {"/opt/camera"})});
  EXPECT_EQ(change_of("camera", none, one).action, ChangeAction::start);
  EXPECT_EQ(to_text(change_of("camera", one, other)), "replace camera: program");
  EXPECT_EQ(to_text(change_of("camera", one, none)), "stop camera");
  EXPECT_THAT(plan_changes(none, none).changes, IsEmpty());
  EXPECT_TRUE(plan_changes(one, one).nothing_to_do());
}

}  // namespace
}  // namespace quoin::deploy
