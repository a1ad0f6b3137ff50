// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/topics/header.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

const char* const two_fitters = R"(
  - {name: front, kind: simulated, qos: lossless, parameters: {rate_hz: 50}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls, strength: 2}
  - {name: wctls, kind: line_fitting, input: walls, method: utls, strength: 1}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)";

/// A chain whose fitter has two instances, and what comes out of it. Everything that waits takes
/// what came meanwhile: the recorder's own reader keeps little.
class Standby : public testing::Test {
 protected:
  /// Whether the scans are made with lines of the process that started at `incarnation`.
  bool heard(std::uint64_t incarnation) {
    return recorder_.poll_until([&] {
      return recorder_.messages().back().header().trace().at(2).incarnation() == incarnation;
    });
  }

  template <class Condition>
  bool wait_for(const std::string& service, Condition condition) {
    return status_.wait_for(service, [&](const msg::ServiceStatus& heartbeat) {
      recorder_.poll();
      return condition(heartbeat);
    });
  }

  /// The incarnation of `process`, once that tells of itself as `service`.
  std::uint64_t incarnation_of(const std::string& service, const Process& process) {
    EXPECT_TRUE(wait_for(service, [&](const msg::ServiceStatus& heartbeat) {
      return static_cast<pid_t>(heartbeat.pid()) == process.pid();
    }));
    return status_.latest(service).incarnation();
  }

  void stop(Process& process, const std::string& service) {
    process.signal(SIGTERM);
    EXPECT_TRUE(wait_for(service, [](const msg::ServiceStatus& heartbeat) {
      return heartbeat.state() == msg::ServiceState::STATE_STOPPED;
    }));
    EXPECT_EQ(process.wait(10s), 0) << process.errors();
  }

  TestDeployment deployment_{two_fitters};
  runtime::Participant participant_{deployment_.participant("test")};
  CornerRecorder recorder_{participant_, deployment_, "corners"};
  StatusRecorder status_{participant_, deployment_};
};

TEST_F(Standby, TakesOverFromAKilledAndFromAHungInstanceUntilThatReturns) {
  Process corners = deployment_.start("corners", 1);
  auto strong = std::make_unique<Process>(deployment_.start("wctls@2"));
  const Process weak = deployment_.start("wctls@1");
  const Process walls = deployment_.start("walls");
  Process front = deployment_.start("front");
  ASSERT_TRUE(recorder_.wait_for(10));
  const std::uint64_t standby = incarnation_of("wctls@1", weak);
  ASSERT_TRUE(heard(incarnation_of("wctls@2", *strong)));

  for (int kill = 0; kill < 2; ++kill) {
    strong->signal(SIGKILL);
    ASSERT_TRUE(heard(standby));
    strong = std::make_unique<Process>(deployment_.start("wctls@2"));
    ASSERT_TRUE(heard(incarnation_of("wctls@2", *strong)));
  }
  strong->signal(SIGSTOP);
  ASSERT_TRUE(heard(standby));
  strong->signal(SIGCONT);
  ASSERT_TRUE(heard(incarnation_of("wctls@2", *strong)));

  stop(front, "front");
  const std::uint64_t published = status_.latest("front").published();
  ASSERT_TRUE(recorder_.poll_until([&] {
    return topics::sequence_number(recorder_.messages().back().header()) + 1 == published;
  }));
  // Each scan at most once and in order, and the others lost by the service that was replaced.
  const auto& messages = recorder_.messages();
  for (std::size_t i = 1; i < messages.size(); ++i) {
    EXPECT_GT(topics::sequence_number(messages[i].header()),
              topics::sequence_number(messages[i - 1].header()));
  }
  const runtime::ScanAccounting& accounting = recorder_.accounting();
  EXPECT_EQ(accounting.duplicates(), 0U);
  EXPECT_EQ(accounting.received() + accounting.lost(), published);
  EXPECT_THAT(accounting.lost_by_site(),
              testing::ElementsAre(testing::Pair(
                  runtime::LossSite{runtime::LossPlace::service, "wctls"}, testing::Gt(0U))));
  stop(corners, "corners");
  EXPECT_EQ(status_.latest("corners").received(), accounting.received());
  EXPECT_EQ(status_.latest("corners").lost(), 0U);
  EXPECT_EQ(status_.latest("corners").upstream_lost(), accounting.lost());
}

TEST(StandbyCommands, KnowEachInstance) {
  const TestDeployment deployment(two_fitters);
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process up = deployment.quoin({"up", "FILE", "--json"});
  ASSERT_TRUE(status.wait_for("corners", [](const auto& s) { return s.published() > 20; }));

  Process ambiguous = deployment.quoin({"swap", "wctls", "pca", "--deployment", "FILE"});
  EXPECT_EQ(ambiguous.wait(20s), 2);
  EXPECT_THAT(ambiguous.errors(), HasSubstr("name one, such as wctls@"));
  Process swap = deployment.quoin({"swap", "wctls@1", "pca", "--deployment", "FILE"});
  EXPECT_EQ(swap.wait(20s), 0) << swap.errors();

  ASSERT_TRUE(status.wait_for("wctls@2", [](const auto& s) { return s.published() > 0; }));
  const auto first = status.latest("wctls@2");
  ASSERT_EQ(kill(static_cast<pid_t>(first.pid()), SIGKILL), 0);
  ASSERT_TRUE(status.wait_for("wctls@2", [&](const auto& s) {
    return s.incarnation() != first.incarnation() && s.published() > 20;
  }));
  Process listing = deployment.quoin({"status", "FILE", "--json"});
  ASSERT_EQ(listing.wait(20s), 0) << listing.errors();
  const auto services = nlohmann::json::parse(listing.output())["services"];
  EXPECT_EQ(services["wctls@1"]["method"], "pca");
  EXPECT_EQ(services["wctls@2"]["method"], "wctls");

  up.signal(SIGINT);
  ASSERT_EQ(up.wait(30s), 0) << up.errors();
  const auto result = nlohmann::json::parse(up.output());
  EXPECT_EQ(result["services"]["wctls@2"]["restarts"], 1);
  EXPECT_EQ(result["services"]["wctls@1"]["restarts"], 0);
  const auto& corners = result["corners"]["corners"];
  EXPECT_EQ(result["corners"].size(), 1U);
  EXPECT_EQ(corners["scans_expected"], result["scans_published"]);
  EXPECT_EQ(corners["scans_delivered"].get<int>() + corners["scans_lost"].get<int>(),
            corners["scans_expected"].get<int>());
  for (const auto& [stage, count] : corners["lost_by_stage"].items()) EXPECT_EQ(stage, "wctls");
  EXPECT_EQ(corners["lost_on_link"], 0);
}

}  // namespace
}  // namespace quoin
