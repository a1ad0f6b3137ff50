// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/starter/first_deployment.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "deploy/kinds/kinds.hpp"

namespace quoin::deploy {
namespace {

const ServiceConfig* find(const Deployment& deployment, std::string_view kind) {
  const auto found = std::ranges::find(deployment.services, kind, &ServiceConfig::kind);
  return found == deployment.services.end() ? nullptr : &*found;
}

std::string parameter(const ServiceConfig& service, std::string_view name) {
  const auto found = std::ranges::find(service.parameters, name, &ParameterSetting::name);
  return found == service.parameters.end() ? "" : found->text;
}

TEST(FirstDeployment, OfEachSourceWithAllAdditionsIsValid) {
  for (const ScanSource source :
       {ScanSource::simulated, ScanSource::rplidar, ScanSource::ros2, ScanSource::recording}) {
    for (int additions = 0; additions < 32; ++additions) {
      FirstDeployment first;
      first.source = source;
      first.recording = "scans.log";
      first.odometry_topic = (additions & 1) != 0 ? "/odom" : "";
      first.circles = (additions & 1) != 0;
      first.map = (additions & 2) != 0;
      first.page = (additions & 4) != 0;
      first.recorder = (additions & 8) != 0;
      first.ros2_output = (additions & 16) != 0;
      const std::string text = deployment_text(first);
      Deployment deployment;
      ASSERT_NO_THROW(deployment = parse_deployment(text, "robot.yaml")) << text;
      EXPECT_EQ(find(deployment, "mapping") != nullptr, first.map);
      EXPECT_EQ(find(deployment, "viewer") != nullptr, first.page);
      EXPECT_EQ(find(deployment, "recorder") != nullptr, first.recorder);
      EXPECT_EQ(find(deployment, "ros2_output") != nullptr, first.ros2_output);
      EXPECT_EQ(find(deployment, "circle_fitting") != nullptr, first.circles);
      EXPECT_NE(find(deployment, "corner_estimation"), nullptr);
    }
  }
}

TEST(FirstDeployment, OdometryGoesToDeskewingAndToTheMap) {
  FirstDeployment first;
  first.source = ScanSource::ros2;
  first.odometry_topic = "/odom";
  first.map = true;
  const Deployment deployment = parse_deployment(deployment_text(first), "robot.yaml");
  for (const char* kind : {"deskewing", "mapping"}) {
    const ServiceConfig* service = find(deployment, kind);
    ASSERT_NE(service, nullptr) << kind;
    EXPECT_TRUE(std::ranges::any_of(service->inputs, [](const InputConfig& input) {
      return input.port == "odometry" && input.service == "odometry";
    })) << kind;
  }
}

TEST(FirstDeployment, SeveralFittersStandSideBySide) {
  FirstDeployment first;
  first.fitters = {"utls", "wctls"};
  first.map = true;
  const Deployment deployment = parse_deployment(deployment_text(first), "robot.yaml");
  EXPECT_EQ(std::ranges::count(deployment.services, "line_fitting", &ServiceConfig::kind), 2);
  EXPECT_EQ(deployment.service("wctls_corners").inputs.front().service, "wctls");
}

TEST(FirstDeployment, TextOfAnyKindStaysText) {
  const std::string odd = "a \"b\" \\ #, {x: y}: 'z' - \xc3\xa4";
  FirstDeployment first;
  first.source = ScanSource::recording;
  first.recording = odd;
  const Deployment deployment = parse_deployment(deployment_text(first), "robot.yaml");
  EXPECT_EQ(parameter(deployment.service("front"), "path"), odd);
  first.recording = "two\nlines";  // is no value of a deployment file
  EXPECT_THROW((void)parse_deployment(deployment_text(first), "robot.yaml"), DeploymentError);
  for (const char* word : {"true", "No", "null", "12", "-", ""}) {
    first.recording = "scans.log";
    first.source = ScanSource::ros2;
    first.scan_topic = word;
    EXPECT_NE(deployment_text(first).find("topic: \"" + std::string(word) + "\""),
              std::string::npos);
  }
}

TEST(FirstDeployment, WhatTheFileWouldReplaceIsRefused) {
  FirstDeployment first;
  first.name_space = "${HOME}";
  EXPECT_THROW((void)deployment_text(first), std::invalid_argument);
}

TEST(FirstDeployment, WrongNamesAreFoundByItsReader) {
  FirstDeployment first;
  first.fitters = {"no_such_method"};
  EXPECT_THROW((void)parse_deployment(deployment_text(first), "robot.yaml"), DeploymentError);
}

}  // namespace
}  // namespace quoin::deploy
