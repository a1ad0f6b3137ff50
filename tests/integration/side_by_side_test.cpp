// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <fstream>
#include <idl/Lines.h>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using tests::Process;
using tests::Recorder;
using tests::StatusRecorder;
using tests::TestDeployment;

/// The services of the example, with corners behind the first fitter only.
std::string sixteen_fitters() {
  std::ifstream file(QUOIN_EXAMPLES_DIR "/sixteen_fitters.yaml");
  std::string services;
  std::string line;
  int corner_services = 0;
  while (std::getline(file, line)) {
    if (line.rfind("  - ", 0) != 0) continue;
    if (line.find("corner_estimation") != std::string::npos && corner_services++ > 0) continue;
    services += line + '\n';
  }
  return services;
}

TEST(SideBySide, SixteenFittersAtTenHertzLoseNoScan) {
  const TestDeployment deployment(sixteen_fitters());
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  tests::CornerRecorder corners(participant, deployment, "wctls_corners");
  std::vector<std::unique_ptr<Recorder<msg::Lines>>> fitters;
  std::vector<Process> processes;
  processes.push_back(deployment.start("wctls_corners", 1));
  for (const auto& service : deployment.deployment().services) {
    if (service.kind != "line_fitting") continue;
    fitters.push_back(
        std::make_unique<Recorder<msg::Lines>>(participant, deployment, service.name));
    processes.push_back(deployment.start(service.name, 1));
  }
  ASSERT_EQ(fitters.size(), 16U);
  // A segmentation waits for its readers, but not as long as a busy machine may need for all.
  for (const auto& fitter : fitters) ASSERT_TRUE(fitter->wait_for_writer());
  processes.push_back(deployment.start("walls"));
  Process front = deployment.start("front");

  const auto all_have = [&](std::size_t count) {
    bool complete = corners.poll() >= count;
    for (const auto& fitter : fitters) complete = fitter->poll() >= count && complete;
    return complete;
  };
  ASSERT_TRUE(tests::eventually([&] { return all_have(20); }, 60s));
  front.signal(SIGTERM);
  ASSERT_EQ(front.wait(10s), 0) << front.errors();
  ASSERT_TRUE(status.wait_for(
      "front", [](const auto& s) { return s.state() == msg::ServiceState::STATE_STOPPED; }));
  const std::uint64_t published = status.latest("front").published();
  EXPECT_TRUE(tests::eventually([&] { return all_have(published); }));

  for (const auto& fitter : fitters) {
    EXPECT_EQ(fitter->accounting().received(), published);
    EXPECT_EQ(fitter->accounting().first_sequence(), 0U);
    EXPECT_THAT(fitter->accounting().lost_by_site(), testing::IsEmpty());
    EXPECT_EQ(fitter->accounting().duplicates(), 0U);
    EXPECT_GE(fitter->messages().back().lines().size(), 4U) << "a room has four walls";
  }
  EXPECT_EQ(corners.accounting().received(), published);
  EXPECT_THAT(corners.accounting().lost_by_site(), testing::IsEmpty());
}

}  // namespace
}  // namespace quoin
