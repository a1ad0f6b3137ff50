// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Joins over a link that is cut for a while, in network namespaces of the test's own.
#include <csignal>
#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/hosts.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using tests::Hosts;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

// [s] Longer than the lease: who is behind the cut is forgotten, and found again.
constexpr int cut = 5;
constexpr int rate_hz = 20;

const char* const services = R"(
  - {name: front, kind: simulated, host: lidar, parameters: {rate_hz: 20, points: 360}}
  - {name: odo, kind: test_odometer, host: lidar, parameters: {rate_hz: 20}}
  - {name: walls, kind: segmentation, input: front, host: compute}
  - {name: lines, kind: line_fitting, input: walls, host: compute}
  - {name: corners, kind: corner_estimation, input: lines, host: compute}
  - {name: moved, kind: test_join, inputs: {lines: odo, scan: front}, host: compute}
  - {name: pose, kind: test_join, inputs: {lines: lines, scan: odo}, host: base}
  - {name: map, kind: test_own_rate, input: corners, parameters: {every: 5}, host: base}
)";

class PortsNetwork : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (const auto why = Hosts::refusal()) GTEST_SKIP() << "skipped: " << *why;
  }
};

TEST_P(PortsNetwork, JoinsOverACutLinkAreCaughtUpWithAndEachMessageIsAccountedFor) {
  const Hosts hosts({"lidar", "compute", "base"});
  const TestDeployment deployment(services,
                                  "network: {interfaces: eth0, discovery: multicast, lease: 3 s}\n",
                                  "quoin_test_tool");
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  std::map<std::string, std::unique_ptr<Process>> ups;
  for (const char* host : {"lidar", "compute", "base"}) {
    ups[host] = hosts.on(host, [&] {
      return std::make_unique<Process>(deployment.quoin({"up", "FILE", "--host", host, "--json"}));
    });
  }
  const auto logs = [&] {
    std::string text;
    for (const auto& [host, up] : ups) text += host + ":\n" + up->errors();
    return text;
  };
  const auto has_published = [&](const std::string& service, std::uint64_t count) {
    return status.wait_for(
        service, [&](const auto& s) { return s.published() >= count; }, 60s);
  };
  for (const char* end : {"pose", "moved", "map"}) ASSERT_TRUE(has_published(end, 40)) << logs();

  // Measured by the steady clock of the sources, of which nothing is heard when their link is cut.
  hosts.cut(GetParam());
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(cut);
  (void)tests::eventually([&] { return std::chrono::steady_clock::now() > until; }, 60s);
  hosts.mend(GetParam());
  for (const char* end : {"pose", "moved", "map"}) {
    ASSERT_TRUE(has_published(end, status.latest(end).published() + 2 * rate_hz)) << logs();
  }

  std::map<std::string, json> figures;
  for (const char* host : {"lidar", "compute", "base"}) {
    ups[host]->signal(SIGINT);
    EXPECT_EQ(ups[host]->wait(40s), 0) << logs();
    figures[host] = json::parse(ups[host]->output(), nullptr, false);
  }
  const auto expect_exact = [&](const json& end, const json& published) {
    EXPECT_EQ(end["scans_delivered"].get<int>() + end["scans_lost"].get<int>(), published)
        << end << logs();
  };
  const auto& sources = figures["lidar"]["services"];
  expect_exact(figures["base"]["ends"]["pose"], sources["front"]["numbered"]["scan"]);
  expect_exact(figures["compute"]["ends"]["moved"], sources["odo"]["numbered"]["lines"]);
  expect_exact(figures["base"]["ends"]["map"],
               figures["base"]["services"]["map"]["numbered"]["corners"]);
}

INSTANTIATE_TEST_SUITE_P(PortsNetwork, PortsNetwork, testing::Values("lidar", "compute", "base"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quoin
