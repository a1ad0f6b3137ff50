// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Kinds with several ports, outputs at their own rate, state, or no output, of tests/kinds.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <idl/Lines.h>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/topics/header.hpp"
#include "tests/integration/harness/test_tool.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
using tests::Recorder;
using tests::TestDeployment;
using tests::TestRun;

/// `qos`: " qos: PRESET," for each service, or "".
std::string all_kinds(const std::string& qos = "") {
  return "  - {name: front, kind: simulated," + qos +
         " parameters: {rate_hz: 20, points: 360}}\n"
         "  - {name: walls, kind: segmentation," +
         qos +
         " input: front}\n"
         "  - {name: lines, kind: line_fitting," +
         qos +
         " input: walls, method: wctls}\n"
         "  - {name: corners, kind: corner_estimation," +
         qos +
         " input: lines}\n"
         "  - {name: odo, kind: test_odometer," +
         qos +
         " parameters: {rate_hz: 25}}\n"
         "  - {name: pose, kind: test_join," +
         qos +
         " inputs: {lines: lines, scan: odo}}\n"
         "  - {name: moved, kind: test_join," +
         qos +
         " inputs: {scan: front, lines: odo}}\n"
         "  - {name: newest, kind: test_latest," +
         qos +
         " inputs: {scan: odo, corners: corners}}\n"
         "  - {name: map, kind: test_own_rate," +
         qos +
         " input: corners, parameters: {every: 5}}\n"
         "  - {name: far_map, kind: test_own_rate," +
         qos +
         " input: newest, parameters: {every: 7}}\n"
         "  - {name: sink, kind: test_sink, input: map}\n"
         "  - {name: tape, kind: test_observer, inputs: all}\n";
}

const std::vector<std::string> ends{"pose", "moved", "far_map"};

std::vector<std::string> sources_of(const msg::Header& header) {
  std::vector<std::string> names;
  for (const msg::Origin& origin : header.origins()) names.push_back(origin.source());
  return names;
}

/// Of each topic that somebody has published to.
std::map<std::string, std::uint64_t> published_by_topic(TestRun& run) {
  std::map<std::string, std::uint64_t> counts;
  for (const ServiceConfig& service : run.deployment().deployment().services) {
    for (const auto& output : run.latest(service.name).outputs()) {
      counts[output.topic()] = output.published();
    }
  }
  return counts;
}

std::map<std::string, std::uint64_t> diagnostics_of(TestRun& run, const std::string& service) {
  std::map<std::string, std::uint64_t> values;
  for (const auto& diagnostic : run.latest(service).diagnostics()) {
    values[diagnostic.name()] = std::stoull(diagnostic.value());
  }
  return values;
}

bool has_stopped(TestRun& run, const std::string& service) {
  return run.status().wait_for(
      service, [](const auto& s) { return s.state() == msg::ServiceState::STATE_STOPPED; });
}

TEST(Ports, EachKindGetsAndGivesWhatItsPortsSayAndAnObserverMissesNothing) {
  TestRun run(all_kinds(), "qos: lossless\n");
  Recorder<msg::Lines> pose(run.participant(), run.deployment(), "pose");
  Recorder<msg::Lines> moved(run.participant(), run.deployment(), "moved");
  CornerRecorder newest(run.participant(), run.deployment(), "newest");
  CornerRecorder map(run.participant(), run.deployment(), "map");
  run.up();
  ASSERT_TRUE(tests::eventually(
      [&] {
        return std::min({pose.poll(), moved.poll(), newest.poll()}) >= 60 && map.poll() >= 10;
      },
      60s))
      << run.log();
  ASSERT_TRUE(run.has_published("sink", 5));

  const auto between = [](const msg::Lines& message) {
    return message.covariance_mode() == "between" || message.covariance_mode() == "same";
  };
  const auto outside = [](const msg::Lines& message) {
    return message.covariance_mode() == "outside";
  };
  for (const auto* joined : {&pose, &moved}) {
    // The first ones may come before their partners do.
    EXPECT_GT(std::ranges::count_if(joined->messages(), between), 40);
    EXPECT_EQ(std::ranges::count_if(joined->messages(), outside), 0);
  }
  EXPECT_THAT(sources_of(pose.messages().back().header()), ElementsAre("front", "odo", "odo"));
  EXPECT_THAT(sources_of(moved.messages().back().header()), ElementsAre("odo", "front", "front"));
  EXPECT_THAT(sources_of(newest.messages().back().header()), ElementsAre("odo", "front"));
  EXPECT_EQ(newest.messages().back().covariance_mode(), "propagated");
  EXPECT_GE(newest.messages().back().corners().size(), 4U);
  EXPECT_EQ(newest.messages().back().header().trace().back().input(), "scan");

  for (std::size_t i = 0; i < map.messages().size(); ++i) {
    const msg::Corners& message = map.messages()[i];
    EXPECT_EQ(message.corners().front().first_line(), 5 * (i + 1));
    EXPECT_THAT(sources_of(message.header()), ElementsAre("map", "front"));
    EXPECT_EQ(topics::sequence_number(message.header()), i);
    EXPECT_EQ(message.header().trace().size(), 1U);
  }

  const json figures = run.end();
  EXPECT_EQ(figures["ends"].size(), ends.size()) << figures["ends"];
  for (const std::string& end : ends) EXPECT_EQ(figures["ends"][end]["scans_lost"], 0) << end;
  EXPECT_GT(figures["services"]["odo"]["numbered"]["lines"],
            figures["services"]["odo"]["numbered"]["scan"]);
  ASSERT_TRUE(has_stopped(run, "tape"));
  for (const auto& [topic, count] : published_by_topic(run)) {
    EXPECT_EQ(diagnostics_of(run, "tape")[topic], count) << topic;
  }
  EXPECT_EQ(run.latest("sink").received(), run.latest("map").outputs().front().published());
  EXPECT_EQ(run.latest("tape").lost(), 0U);
}

class KilledPorts : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(KilledPorts, AreStartedAgainAndEachMessageIsAccountedFor) {
  TestRun run(all_kinds());
  run.up();
  for (const std::string& end : ends) ASSERT_TRUE(run.has_published(end, 20)) << run.log();
  for (const std::string& service : GetParam()) {
    ASSERT_TRUE(run.goes_on(service, 1)) << service;
    ASSERT_TRUE(run.kill_and_wait(service)) << service << run.log();
    for (const std::string& end : ends) {
      ASSERT_TRUE(run.goes_on(end, 10)) << end << " after " << service << run.log();
    }
  }
  const json figures = run.end();
  for (const std::string& service : GetParam()) {
    EXPECT_EQ(figures["services"][service]["restarts"], 1) << service;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ports, KilledPorts,
    testing::Values(std::vector<std::string>{"front", "walls", "lines", "corners"},
                    std::vector<std::string>{"odo", "pose", "moved", "newest"},
                    std::vector<std::string>{"map", "far_map", "sink", "tape"}));

/// What `map` has counted goes on by five from message to message.
void expect_no_gap(const std::vector<msg::Corners>& messages) {
  for (std::size_t i = 1; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].corners().front().first_line(),
              messages[i - 1].corners().front().first_line() + 5)
        << i << ": " << messages[i].header().trace().front().method();
  }
}

TEST(Ports, ASwapCarriesTheStateOverAndIsRefusedWhereItCannot) {
  TestRun run(all_kinds(), "qos: lossless\n");
  CornerRecorder map(run.participant(), run.deployment(), "map");
  run.up();
  const auto ask = [&](std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.end(), {"--deployment", run.deployment().file().string()});
    Process asked = run.tool(arguments);
    EXPECT_TRUE(tests::eventually([&] {
      map.poll();
      return asked.wait(0ms).has_value();
    }));
    EXPECT_EQ(asked.wait(0ms), exit_code) << asked.output() << asked.errors();
    return asked.output() + asked.errors();
  };
  ASSERT_TRUE(map.wait_for(3)) << run.log();
  ask({"swap", "map", "recount", "every=5"}, 0);
  ASSERT_TRUE(map.wait_for(map.poll() + 3));
  EXPECT_EQ(map.messages().back().header().trace().front().method(), "recount");
  EXPECT_THAT(ask({"swap", "map", "count_otherwise", "every=5"}, 2), HasSubstr("--drop-state"));
  ask({"set", "map", "every=5"}, 0);
  ASSERT_TRUE(map.wait_for(map.poll() + 3));
  expect_no_gap(map.messages());

  ask({"swap", "map", "count_otherwise", "every=5", "--drop-state"}, 0);
  ASSERT_TRUE(tests::eventually([&] {
    map.poll();
    return map.messages().back().header().trace().front().method() == "count_otherwise";
  }));
  EXPECT_EQ(map.messages().back().corners().front().first_line(), 5U);
  EXPECT_THAT(ask({"set", "sink", "every=5"}, 2), HasSubstr("every"));
  EXPECT_THAT(ask({"swap", "sink", "count"}, 2), HasSubstr("has no methods"));
  const json figures = run.end();
  for (const std::string& end : ends) EXPECT_EQ(figures["ends"][end]["scans_lost"], 0) << end;
}

TEST(Ports, ApplyReplacesEachOfThemAndTheirStateGoesOn) {
  TestRun run(all_kinds(" qos: lossless,"));
  CornerRecorder map(run.participant(), run.deployment(), "map");
  run.up();
  ASSERT_TRUE(map.wait_for(3)) << run.log();
  for (const std::string& end : ends) ASSERT_TRUE(run.has_published(end, 20)) << run.log();
  std::map<std::string, std::uint64_t> before;
  const auto services = run.deployment().deployment().services;
  for (const auto& service : services)
    before[service.name] = run.latest(service.name).incarnation();

  const auto changed = run.deployment().write("changed.yaml", all_kinds(" qos: feature,"));
  Process apply = run.tool({"apply", changed.string(), "--json"});
  ASSERT_TRUE(tests::eventually(
      [&] {
        map.poll();
        return apply.wait(0ms).has_value();
      },
      60s));
  ASSERT_EQ(apply.wait(0ms), 0) << apply.errors() << apply.output() << run.log();
  const json outcome = json::parse(apply.output());
  for (const json& step : outcome["steps"]) EXPECT_EQ(step["action"], "replace") << step;
  for (const auto& service : services) {
    ASSERT_TRUE(run.status().wait_for(service.name,
                                      [&](const auto& s) {
                                        return s.incarnation() != before[service.name] &&
                                               TestRun::handled(s) > 10;
                                      }))
        << service.name << run.log();
  }
  ASSERT_TRUE(map.wait_for(12)) << map.messages().size();
  for (std::size_t i = 0; i < map.messages().size(); ++i) {
    EXPECT_EQ(topics::sequence_number(map.messages()[i].header()), i) << "numbers go on";
  }
  expect_no_gap(map.messages());
  const json figures = run.end();
  for (const std::string& end : ends) {
    EXPECT_EQ(figures["ends"][end]["scans_lost"], 0) << end << figures["ends"][end] << run.log();
  }
  for (const auto& service : services) {
    EXPECT_EQ(figures["services"][service.name]["restarts"], 0) << service.name << run.log();
  }
}

TEST(Ports, AJoinGoesOnWithoutAPartnerThatDiesAndWithItWhenItIsBack) {
  TestRun run(all_kinds());
  Recorder<msg::Lines> pose(run.participant(), run.deployment(), "pose");
  run.up();
  ASSERT_TRUE(pose.wait_for(20)) << run.log();
  const pid_t odo = run.pid_of("odo");
  ASSERT_EQ(kill(odo, SIGSTOP), 0);
  ASSERT_TRUE(run.status().wait_for("pose", [](const auto& s) {
    return s.detail().find("port scan from 'odo'") != std::string::npos &&
           s.inputs()[1].unjoined() > 10;
  })) << run.latest("pose").detail();
  const std::size_t alone = pose.poll();
  ASSERT_TRUE(pose.wait_for(alone + 40)) << "results go on";
  EXPECT_EQ(pose.messages().back().covariance_mode(), "before");

  ASSERT_EQ(kill(odo, SIGKILL), 0);
  ASSERT_TRUE(tests::eventually([&] {
    pose.poll();
    return pose.messages().back().covariance_mode() == "between";
  })) << run.log();
  ASSERT_TRUE(run.status().wait_for("pose", [](const auto& s) { return s.detail().empty(); }));
  const json figures = run.end();
  EXPECT_EQ(figures["ends"]["pose"]["scans_lost"], 0) << figures["ends"]["pose"];
}

TEST(Ports, ServicesMayBeCalledLikeThePlacesWhereMessagesAreLost) {
  TestRun run(
      "  - {name: front, kind: simulated, parameters: {rate_hz: 20, points: 360}}\n"
      "  - {name: link, kind: segmentation, input: front}\n"
      "  - {name: start, kind: line_fitting, input: link}\n"
      "  - {name: end, kind: corner_estimation, input: start}\n",
      "qos: lossless\n");
  run.up();
  ASSERT_TRUE(run.has_published("end", 20)) << run.log();
  for (const char* service : {"link", "start", "end"}) {
    ASSERT_TRUE(run.kill_and_wait(service)) << run.log();
    ASSERT_TRUE(run.goes_on("end", 20)) << service << run.log();
  }
  const json end = run.end()["ends"]["end"];
  for (const char* service : {"link", "start", "end"}) {
    EXPECT_GT(end["lost_by_stage"][service], 0) << end;
  }
  EXPECT_EQ(end["lost_on_link"], 0) << end;
  EXPECT_EQ(end["lost_at_start"], 0) << end;
  EXPECT_EQ(end["lost_at_end"], 0) << end;
}

}  // namespace
}  // namespace quoin
