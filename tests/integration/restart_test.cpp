// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/topics/header.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using tests::CornerRecorder;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

TEST(Restart, AKilledStageThatComesBackIsCaughtUpWithAndItsLossesAreItsOwn) {
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 50}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)");
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder recorder(participant, deployment, "corners");
  StatusRecorder status(participant, deployment);
  Process corners = deployment.start("corners", 1);
  Process wctls = deployment.start("wctls");
  auto walls = std::make_unique<Process>(deployment.start("walls"));
  Process front = deployment.start("front");
  ASSERT_TRUE(recorder.wait_for(20));

  walls->signal(SIGKILL);
  ASSERT_EQ(walls->wait(10s), 128 + SIGKILL);
  walls = std::make_unique<Process>(deployment.start("walls"));
  const std::size_t before = recorder.poll();
  ASSERT_TRUE(recorder.wait_for(before + 50, 40s));

  front.signal(SIGTERM);
  ASSERT_EQ(front.wait(10s), 0) << front.errors();
  ASSERT_TRUE(status.wait_for(
      "front", [](const auto& s) { return s.state() == msg::ServiceState::STATE_STOPPED; }));
  const std::uint64_t published = status.latest("front").published();
  ASSERT_TRUE(recorder.wait_for(1));
  ASSERT_TRUE(recorder.poll_until([&] {
    return topics::sequence_number(recorder.messages().back().header()) + 1 == published;
  }));
  // Every scan is delivered or lost, and the lost ones are on the account of the stage that was
  // killed.
  EXPECT_EQ(recorder.accounting().received() + recorder.accounting().lost(), published);
  EXPECT_GT(recorder.accounting().lost(), 0U);
  EXPECT_THAT(recorder.accounting().lost_by_site(),
              testing::ElementsAre(testing::Pair(
                  runtime::LossSite{runtime::LossPlace::service, "walls"}, testing::Gt(0U))));
  EXPECT_EQ(recorder.accounting().duplicates(), 0U);
}

}  // namespace
}  // namespace quoin
