// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Running services beside a hostile neighbour, without `quoin`: small enough to be built with
// AddressSanitizer and UndefinedBehaviorSanitizer, whose reports end a process with another code.
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/hostile_neighbour.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

TEST(AttackedServices, GoOnAndEndAsIfNobodyHadAttackedThem) {
  const tests::TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 10, points: 180}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: lines, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: lines}
)");
  std::map<std::string, tests::Process> services;
  for (const char* name : {"corners", "lines", "walls", "front"}) {
    services.emplace(name, deployment.start(name));
  }
  runtime::Participant participant(deployment.participant("test"));
  tests::StatusRecorder status(participant, deployment);
  const auto active = [](const msg::ServiceStatus& s) { return s.state() == msg::STATE_ACTIVE; };
  for (const auto& [name, process] : services) {
    ASSERT_TRUE(status.wait_for(name, active)) << name << process.errors();
  }
  constexpr int attacks = 12;
  tests::HostileNeighbour neighbour(deployment, "front", "walls", "lines", 20261128);
  ASSERT_TRUE(tests::eventually([&] {
    neighbour.listen();
    return neighbour.informed();
  }));
  for (int attack = 0; attack < attacks; ++attack) {
    neighbour.listen();
    neighbour.attack();
    std::this_thread::sleep_for(50ms);  // as often as it lets them work
  }
  EXPECT_GE(neighbour.counts().at("garbage"), attacks);
  for (const char* name : {"walls", "lines", "corners"}) {
    EXPECT_TRUE(status.wait_for(name, [&](const msg::ServiceStatus& heartbeat) {
      return active(heartbeat) && !heartbeat.inputs()[0].refused().empty();
    })) << name;
  }
  for (auto& [name, process] : services) {
    process.signal(SIGTERM);
    EXPECT_EQ(process.wait(20s), 0) << name << process.errors();
    EXPECT_THAT(process.errors(), Not(HasSubstr("runtime error"))) << name;
  }
}

}  // namespace
}  // namespace quoin
