// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/topics/header.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

constexpr auto front = "  - {name: front, kind: simulated, parameters: {rate_hz: 50}}\n";
constexpr auto walls = "  - {name: walls, kind: segmentation, input: front, method: iepf}\n";
constexpr auto wctls = "  - {name: wctls, kind: line_fitting, input: walls, method: wctls}\n";
constexpr auto corners =
    "  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}\n";
constexpr auto utls = "  - {name: utls, kind: line_fitting, input: walls, method: utls}\n";
constexpr auto utls_corners =
    "  - {name: utls_corners, kind: corner_estimation, input: utls, method: adjacent}\n";
constexpr auto more_walls =
    "  - {name: more_walls, kind: segmentation, input: front, method: split_and_merge}\n";

std::string all_of(std::initializer_list<const char*> services) {
  std::string text;
  for (const char* service : services) text += service;
  return text;
}

/// A deployment that is up and gives corners.
class Apply : public testing::Test {
 protected:
  void start(const std::string& services, std::vector<std::string> arguments = {}) {
    // A machine that is busy elsewhere may stall for more scans than are kept otherwise.
    deployment_.emplace(services, "qos: lossless\n");
    participant_.emplace(deployment_->participant("test"));
    status_.emplace(*participant_, *deployment_);
    arguments.insert(arguments.begin(), {"up", "FILE", "--json"});
    up_.emplace(deployment_->quoin(arguments));
    // Not before all are matched: corners must not take this reader for the one that it waits for.
    ASSERT_TRUE(status_->wait_for("front", [](const auto& s) {
      return s.state() == msg::ServiceState::STATE_ACTIVE;
    })) << up_->errors();
    recorder_.emplace(*participant_, *deployment_, "corners");
    ASSERT_TRUE(recorder_->wait_for(20)) << up_->errors();
  }

  /// `quoin apply --json` with what it prints.
  json apply(const std::filesystem::path& file, int exit_code,
             std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(), {"apply", file.string(), "--json"});
    Process process = deployment_->quoin(arguments);
    EXPECT_TRUE(recorder_->poll_until([&] { return process.wait(0ms).has_value(); }, 60s));
    EXPECT_EQ(process.wait(0ms), exit_code) << process.errors() << up_->errors();
    errors_ = process.errors();
    return json::accept(process.output()) ? json::parse(process.output()) : json();
  }

  /// The process of each service, once all of them report to be at work.
  std::map<std::string, std::uint32_t> processes(const std::vector<std::string>& services) {
    std::map<std::string, std::uint32_t> found;
    for (const std::string& service : services) {
      EXPECT_TRUE(status_->wait_for(service, [](const auto& s) {
        return s.state() == msg::ServiceState::STATE_ACTIVE;
      })) << service;
      found[service] = status_->latest(service).pid();
    }
    return found;
  }

  /// From the first message on no scan is missing, doubled or out of order.
  void expect_every_scan() {
    ASSERT_TRUE(recorder_->wait_for(recorder_->poll() + 20)) << up_->errors();
    std::uint64_t number = topics::sequence_number(recorder_->messages().front().header());
    for (const msg::Corners& message : recorder_->messages()) {
      ASSERT_EQ(topics::sequence_number(message.header()), number++);
    }
    EXPECT_THAT(recorder_->accounting().lost_by_site(), testing::IsEmpty());
    EXPECT_EQ(recorder_->accounting().duplicates(), 0U);
  }

  json end() {
    up_->signal(SIGINT);
    EXPECT_EQ(up_->wait(30s), 0) << up_->errors();
    return json::parse(up_->output());
  }

  static json step(const json& outcome, const std::string& service) {
    for (const json& step : outcome["steps"]) {
      if (step["service"] == service) return step;
    }
    return {};
  }

  std::optional<TestDeployment> deployment_;
  std::optional<runtime::Participant> participant_;
  std::optional<CornerRecorder> recorder_;
  std::optional<StatusRecorder> status_;
  std::optional<Process> up_;
  std::string errors_;
};

TEST_F(Apply, RewiresAddsAndRemovesWithoutTouchingTheRest) {
  start(all_of({front, walls, more_walls, wctls, corners}));
  const std::vector<std::string> kept{"front", "walls", "more_walls", "corners"};
  const auto before = processes({"front", "walls", "more_walls", "corners", "wctls"});

  // Another input for wctls, a fitter with its corners beside it, and another method.
  const json added = apply(
      deployment_->write(
          "added.yaml",
          all_of(
              {front, walls,
               "  - {name: more_walls, kind: segmentation, input: front, method: hierarchical}\n",
               "  - {name: wctls, kind: line_fitting, input: more_walls, method: wctls}\n", corners,
               utls, utls_corners})),
      0);
  EXPECT_EQ(step(added, "front")["action"], "keep");
  EXPECT_EQ(step(added, "more_walls")["action"], "swap");
  EXPECT_EQ(step(added, "utls_corners")["action"], "start");
  const json rewired = step(added, "wctls");
  EXPECT_EQ(rewired["detail"], "input walls -> more_walls");
  const auto first = rewired["first_sequence_number"].get<std::uint64_t>();
  EXPECT_GT(first, 0U);
  expect_every_scan();
  EXPECT_GT(topics::sequence_number(recorder_->messages().back().header()), first);
  for (const msg::Corners& message : recorder_->messages()) {
    const bool after = topics::sequence_number(message.header()) >= first;
    EXPECT_EQ(message.header().trace()[1].service(), after ? "more_walls" : "walls");
  }
  const auto after = processes({"front", "walls", "more_walls", "corners", "wctls"});
  for (const std::string& service : kept) EXPECT_EQ(after.at(service), before.at(service));
  EXPECT_NE(after.at("wctls"), before.at("wctls"));
  EXPECT_TRUE(
      status_->wait_for("more_walls", [](const auto& s) { return s.method() == "hierarchical"; }));

  // Back again, as the file of the start has it.
  ASSERT_TRUE(status_->wait_for("utls_corners", [](const auto& s) { return s.published() > 0; }));
  const json removed = apply(deployment_->file(), 0);
  EXPECT_EQ(step(removed, "utls")["action"], "stop");
  EXPECT_EQ(step(removed, "more_walls")["action"], "swap");
  expect_every_scan();
  const auto last = processes({"front", "walls", "more_walls", "corners"});
  for (const std::string& service : kept) EXPECT_EQ(last.at(service), before.at(service));

  const json figures = end();
  EXPECT_EQ(figures["services"]["utls_corners"]["state"], "removed");
  EXPECT_EQ(figures["services"]["wctls"]["restarts"], 0);
  for (const char* name : {"corners", "utls_corners"}) {
    EXPECT_GT(figures["corners"][name]["scans_delivered"], 0) << name;
    EXPECT_EQ(figures["corners"][name]["scans_lost"], 0) << name << up_->errors();
  }
  EXPECT_EQ(figures["corners"]["corners"]["scans_delivered"], figures["scans_published"]);
}

TEST_F(Apply, ReplacesASourceAndTheStagesBehindIt) {
  start(all_of({front, walls, wctls, corners}));
  const auto before = processes({"front", "walls", "wctls", "corners"});
  const json outcome =
      apply(deployment_->write(
                "faster.yaml",
                all_of({"  - {name: front, kind: simulated, parameters: {rate_hz: 80}}\n",
                        "  - {name: walls, kind: segmentation, input: front, qos: feature}\n",
                        wctls, corners})),
            0);
  for (const char* service : {"front", "walls", "wctls"}) {
    EXPECT_EQ(step(outcome, service)["action"], "replace") << service;
  }
  expect_every_scan();
  const auto after = processes({"front", "walls", "wctls", "corners"});
  EXPECT_NE(after.at("front"), before.at("front"));
  EXPECT_EQ(after.at("corners"), before.at("corners"));
  const json figures = end();
  EXPECT_EQ(figures["corners"]["corners"]["scans_lost"], 0) << figures;
  EXPECT_EQ(figures["corners"]["corners"]["scans_delivered"], figures["scans_published"]);
}

TEST_F(Apply, WhatCannotBeAppliedChangesNothing) {
  start(all_of({front, walls, wctls, corners}));
  const std::vector<std::string> services{"front", "walls", "wctls", "corners"};
  const auto before = processes(services);

  const json planned =
      apply(deployment_->write("more.yaml", all_of({front, walls, wctls, corners, utls})), 0,
            {"--dry-run"});
  EXPECT_EQ(step(planned, "utls")["action"], "start");

  apply(deployment_->write("wrong.yaml",
                           all_of({front, walls,
                                   "  - {name: wctls, kind: line_fitting, input: walls, method: "
                                   "wclts}\n"})),
        2);
  EXPECT_THAT(errors_, HasSubstr("did you mean 'wctls'?"));

  // Its file is not there, which only its process can find out.
  const json failed = apply(
      deployment_->write(
          "missing.yaml",
          all_of({front, walls,
                  "  - {name: wctls, kind: line_fitting, input: walls, method: utls}\n", corners,
                  "  - {name: rear, kind: replay, parameters: {path: nowhere.csv}}\n"})),
      1);
  EXPECT_EQ(failed["rolled_back"], true);
  EXPECT_THAT(failed["detail"].get<std::string>(), HasSubstr("nowhere.csv"));

  expect_every_scan();
  EXPECT_EQ(processes(services), before);
  for (const msg::Corners& message : recorder_->messages()) {
    EXPECT_EQ(message.header().trace()[2].method(), "wctls");
  }
  const json figures = end();
  EXPECT_EQ(figures["services"].size(), 4U);
  EXPECT_EQ(figures["corners"]["corners"]["scans_lost"], 0) << figures;
}

TEST_F(Apply, WatchesItsFile) {
  start(all_of({front, walls, wctls, corners}), {"--watch"});
  const auto before = processes({"walls", "wctls"});
  (void)deployment_->write("deployment.yaml",
                           all_of({front, walls, wctls, "  - {name: corners}\n"}));
  ASSERT_TRUE(recorder_->poll_until(
      [&] { return up_->errors().find("was not applied") != std::string::npos; }));
  EXPECT_THAT(up_->errors(), HasSubstr("has no kind"));
  // As editors do it.
  const auto saved = deployment_->write(
      "deployment.yaml.new",
      all_of({front, walls, "  - {name: wctls, kind: line_fitting, input: walls, method: utls}\n",
              corners}));
  std::filesystem::rename(saved, deployment_->file());
  ASSERT_TRUE(recorder_->poll_until([&] {
    return recorder_->messages().back().header().trace()[2].method() == "utls";
  })) << up_->errors();
  expect_every_scan();
  EXPECT_EQ(processes({"walls", "wctls"}), before);
}

}  // namespace
}  // namespace quoin
