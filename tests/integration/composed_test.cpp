// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Several services in one process.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <idl/Lines.h>
#include <idl/Segments.h>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/topics/header.hpp"
#include "tests/integration/harness/keys.hpp"
#include "tests/integration/harness/test_tool.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
using tests::Recorder;
using tests::TestDeployment;
using tests::TestRun;

const std::string chain =
    "  - {name: front, kind: simulated, parameters: {rate_hz: 50, points: 360}}\n"
    "  - {name: walls, kind: segmentation, input: front, method: iepf}\n"
    "  - {name: wctls, kind: line_fitting, input: walls, method: wctls}\n"
    "  - {name: corners, kind: corner_estimation, input: wctls}\n";
const std::string in_one_process = "processes: {perception: [walls, wctls, corners]}\n";
const std::vector<std::string> stages{"walls", "wctls", "corners"};

constexpr auto is_active = [](const msg::ServiceStatus& status) {
  return status.state() == msg::ServiceState::STATE_ACTIVE;
};

std::set<pid_t> pids_of(TestRun& run, const std::vector<std::string>& services) {
  std::set<pid_t> pids;
  for (const std::string& service : services) {
    EXPECT_TRUE(run.status().wait_for(service, is_active)) << service << run.log();
    pids.insert(run.pid_of(service));
  }
  return pids;
}

/// From the first message on no scan is missing, doubled or out of order.
void expect_every_scan(CornerRecorder& recorder) {
  ASSERT_TRUE(recorder.wait_for(recorder.poll() + 20));
  std::uint64_t number = topics::sequence_number(recorder.messages().front().header());
  for (const msg::Corners& message : recorder.messages()) {
    ASSERT_EQ(topics::sequence_number(message.header()), number++);
  }
  EXPECT_THAT(recorder.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_EQ(recorder.accounting().duplicates(), 0U);
}

/// The same for a reader that a new process of the service does not know to wait for: it may miss
/// the first scans of that, which the figures of `quoin up` tell apart from losses.
void expect_in_order(CornerRecorder& recorder) {
  ASSERT_TRUE(recorder.wait_for(recorder.poll() + 20));
  std::uint64_t next = 0;
  for (const msg::Corners& message : recorder.messages()) {
    ASSERT_GE(topics::sequence_number(message.header()), next);
    next = topics::sequence_number(message.header()) + 1;
  }
  EXPECT_EQ(recorder.accounting().duplicates(), 0U);
}

/// `quoin apply --json` while somebody reads.
json apply(TestRun& run, CornerRecorder& recorder, const std::string& services, int exit_code = 0) {
  const auto file = run.deployment().write("changed.yaml", services);
  Process process = run.tool({"apply", file.string(), "--json"});
  EXPECT_TRUE(recorder.poll_until([&] { return process.wait(0ms).has_value(); }, 60s));
  EXPECT_EQ(process.wait(0ms), exit_code) << process.errors() << run.log();
  return json::parse(process.output(), nullptr, false);
}

TEST(Composed, AChainInOneProcessGivesEveryScanAndAnybodyOutsideCanReadInside) {
  TestRun run(chain + in_one_process, "qos: lossless\n");
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(20)) << run.log();
  EXPECT_EQ(pids_of(run, stages).size(), 1U);
  EXPECT_FALSE(pids_of(run, stages).contains(run.pid_of("front")));

  Recorder<msg::Segments> segments(run.participant(), run.deployment(), "walls");
  ASSERT_TRUE(segments.wait_for(20)) << run.log();
  EXPECT_THAT(segments.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_EQ(segments.messages().back().header().trace().back().service(), "walls");
  expect_every_scan(corners);
  for (const std::string& service : stages) {
    for (const auto& input : run.latest(service).inputs()) EXPECT_EQ(input.writers(), 1U);
    EXPECT_EQ(run.latest(service).inputs().size(), 1U);
  }
  const json figures = run.end();
  EXPECT_EQ(figures["corners"]["corners"]["scans_lost"], 0) << figures;
  EXPECT_EQ(figures["corners"]["corners"]["scans_delivered"], figures["scans_published"]);
}

TEST(Composed, AFiniteSourceEndsTheProcessThatItIsIn) {
  TestRun run(
      "  - {name: front, kind: simulated, parameters: {rate_hz: 100, points: 360, scans: 50}}\n"
      "  - {name: walls, kind: segmentation, input: front}\n"
      "  - {name: wctls, kind: line_fitting, input: walls}\n"
      "  - {name: corners, kind: corner_estimation, input: wctls}\n"
      "processes: {all: [front, walls, wctls, corners]}\n",
      "qos: lossless\n");
  Process up = run.tool({"up", "FILE", "--json"});
  ASSERT_EQ(up.wait(40s), 0) << up.errors();
  const json figures = json::parse(up.output());
  EXPECT_EQ(figures["scans_published"], 50);
  EXPECT_EQ(figures["corners"]["corners"]["scans_delivered"], 50) << figures << up.errors();
  EXPECT_EQ(figures["services"]["front"]["state"], "finished");
  EXPECT_EQ(figures["services"]["corners"]["state"], "stopped");
}

TEST(Composed, MethodsAndParametersAreExchangedInside) {
  TestRun run(chain + in_one_process, "qos: lossless\n");
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(20)) << run.log();
  Process swap = run.tool({"swap", "wctls", "utls", "--deployment", "FILE"});
  if (swap.wait(20s) != 0) {
    GTEST_FAIL() << swap.output() << swap.errors();
  }
  expect_every_scan(corners);
  EXPECT_EQ(corners.messages().back().header().trace()[2].method(), "utls");
  EXPECT_EQ(corners.messages().front().header().trace()[2].method(), "wctls");
  (void)run.end();
}

TEST(Composed, AKilledProcessComesBackAndItsLossesAreThoseOfItsServices) {
  TestRun run(chain + in_one_process);
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(20)) << run.log();
  ASSERT_TRUE(run.kill_and_wait("wctls")) << run.log();
  EXPECT_EQ(pids_of(run, stages).size(), 1U);
  ASSERT_TRUE(corners.wait_for(corners.poll() + 20)) << run.log();
  const json figures = run.end();
  for (const std::string& service : stages) {
    EXPECT_EQ(figures["services"][service]["restarts"], 1) << service << run.log();
  }
}

TEST(Composed, ServicesMoveIntoAProcessAndOutOfItWithoutALoss) {
  TestRun run(chain, "qos: lossless\n");
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(20)) << run.log();
  EXPECT_EQ(pids_of(run, stages).size(), 3U);

  const json together = apply(run, corners, chain + in_one_process);
  EXPECT_EQ(together["steps"][0]["action"], "keep") << together;
  EXPECT_EQ(together["steps"][1]["action"], "replace") << together;
  EXPECT_EQ(together["steps"][1]["detail"], "process its own -> perception");
  expect_in_order(corners);
  EXPECT_EQ(pids_of(run, stages).size(), 1U);

  const json fewer = apply(run, corners, chain + "processes: {perception: [walls, corners]}\n");
  EXPECT_EQ(fewer["steps"][1]["detail"], "with its process perception") << fewer;
  EXPECT_EQ(fewer["steps"][2]["detail"], "process perception -> its own");
  expect_in_order(corners);
  EXPECT_EQ(pids_of(run, {"walls", "corners"}).size(), 1U);
  EXPECT_EQ(pids_of(run, stages).size(), 2U);

  (void)apply(run, corners, chain + "processes: {all: [front, walls, wctls, corners]}\n");
  expect_in_order(corners);
  EXPECT_EQ(pids_of(run, {"front", "walls", "wctls", "corners"}).size(), 1U);

  (void)apply(run, corners, chain);
  expect_in_order(corners);
  EXPECT_EQ(pids_of(run, stages).size(), 3U);
  const json figures = run.end();
  EXPECT_EQ(figures["corners"]["corners"]["scans_lost"], 0) << figures << run.log();
  EXPECT_EQ(figures["corners"]["corners"]["scans_delivered"], figures["scans_published"]);
}

TEST(Composed, AServiceCanBeAddedToAProcessAndTakenOutOfTheDeployment) {
  TestRun run(chain + in_one_process, "qos: lossless\n");
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(20)) << run.log();
  const std::string more =
      "  - {name: utls, kind: line_fitting, input: walls, method: utls}\n"
      "processes: {perception: [walls, wctls, corners, utls]}\n";
  (void)apply(run, corners, chain + more);
  expect_in_order(corners);
  EXPECT_EQ(pids_of(run, {"walls", "wctls", "corners", "utls"}).size(), 1U);
  (void)apply(run, corners, chain + in_one_process);
  expect_in_order(corners);
  const json figures = run.end();
  EXPECT_EQ(figures["services"]["utls"]["state"], "removed");
  EXPECT_EQ(figures["corners"]["corners"]["scans_delivered"], figures["scans_published"]);
  EXPECT_EQ(figures["corners"]["corners"]["scans_lost"], 0) << figures << run.log();
}

TEST(Composed, AProcessHasOneIdentityThatMayDoWhatItsServicesDo) {
  const TestDeployment deployment(chain + in_one_process, "qos: lossless\nsecurity: {keys: keys}\n",
                                  "quoin_test_tool");
  tests::make_keys(deployment);
  const std::filesystem::path identities =
      deployment.deployment().security->directory / "identities";
  EXPECT_TRUE(std::filesystem::exists(identities / "perception"));
  EXPECT_FALSE(std::filesystem::exists(identities / "walls"));
  Process up = deployment.quoin({"up", "FILE", "--json", "--duration", "3"});
  ASSERT_EQ(up.wait(60s), 0) << up.errors();
  const json figures = json::parse(up.output());
  EXPECT_GT(figures["scans_published"], 50);
  EXPECT_EQ(figures["corners"]["corners"]["scans_delivered"], figures["scans_published"])
      << figures << up.errors();
}

TEST(Composed, AProcessOfInstancesStandsInForAnother) {
  TestRun run(
      "  - {name: front, kind: simulated, parameters: {rate_hz: 50, points: 360}}\n"
      "  - {name: walls, kind: segmentation, input: front, strength: 2}\n"
      "  - {name: walls, kind: segmentation, input: front, strength: 1}\n"
      "  - {name: wctls, kind: line_fitting, input: walls, strength: 2}\n"
      "  - {name: wctls, kind: line_fitting, input: walls, strength: 1}\n"
      "  - {name: corners, kind: corner_estimation, input: wctls}\n"
      "processes: {main: [walls@2, wctls@2], backup: [walls@1, wctls@1]}\n");
  CornerRecorder corners(run.participant(), run.deployment(), "corners");
  run.up();
  ASSERT_TRUE(corners.wait_for(20)) << run.log();
  EXPECT_EQ(pids_of(run, {"walls@2", "wctls@2"}).size(), 1U);
  EXPECT_EQ(pids_of(run, {"walls@1", "wctls@1"}).size(), 1U);
  const auto strong = run.latest("walls@2").incarnation();
  EXPECT_EQ(corners.messages().back().header().trace()[1].incarnation(), strong);
  ASSERT_TRUE(run.kill_and_wait("walls@2")) << run.log();
  ASSERT_TRUE(corners.wait_for(corners.poll() + 50)) << run.log();
  const auto weak = run.latest("walls@1").incarnation();
  EXPECT_TRUE(std::ranges::any_of(corners.messages(), [&](const msg::Corners& message) {
    return message.header().trace()[1].incarnation() == weak;
  })) << run.log();
  (void)run.end();
}

TEST(Composed, AServiceThatThrowsOrHangsIsNamedAndTheOthersGoOn) {
  TestRun run(
      chain +
      "  - {name: throws, kind: test_faulty, input: corners, parameters: {throw_every: 3}}\n"
      "  - {name: hangs, kind: test_faulty, input: corners, parameters: {hang_at: 5}}\n"
      "processes: {perception: [walls, wctls, corners, throws, hangs]}\n");
  run.up();
  ASSERT_TRUE(run.has_published("throws", 20)) << run.log();
  EXPECT_TRUE(run.status().wait_for("hangs", [](const auto& status) {
    return status.state() == msg::ServiceState::STATE_FAILED;
  })) << run.log();
  EXPECT_THAT(run.latest("hangs").detail(), HasSubstr("hangs"));
  EXPECT_TRUE(run.goes_on("corners", 20)) << run.log();
  EXPECT_TRUE(run.goes_on("throws", 10)) << run.log();
  EXPECT_GT(run.latest("throws").lost(), 0U);
  EXPECT_THAT(run.log(), HasSubstr("[throws] error"));
  EXPECT_EQ(run.latest("corners").lost(), 0U);
  EXPECT_TRUE(run.goes_on("hangs", 5)) << "it came back";
  EXPECT_EQ(pids_of(run, {"walls", "throws", "hangs"}).size(), 1U);
  (void)run.end();
}

}  // namespace
}  // namespace quoin
