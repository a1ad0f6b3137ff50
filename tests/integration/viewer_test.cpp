// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/integration/harness/keys.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using tests::Process;
using tests::TestDeployment;

constexpr const char* services = R"(
  - {name: front, kind: simulated, parameters: {environment: domestic_room, rate_hz: 10}}
  - {name: walls, kind: segmentation, input: front}
  - {name: utls, kind: line_fitting, input: walls, method: utls}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: utls_corners, kind: corner_estimation, input: utls}
  - {name: wctls_corners, kind: corner_estimation, input: wctls}
  - {name: page, kind: viewer, inputs: all, parameters: {port: 0}}
)";

/// A script of tests/npm, run by node where its packages are (npm install).
std::optional<Process> client(const std::string& script, std::vector<std::string> arguments,
                              const TestDeployment& deployment) {
  const std::filesystem::path folder = QUOIN_CLIENTS_DIR;
  if (!std::filesystem::exists("/usr/bin/node") ||
      !std::filesystem::exists(folder / "node_modules")) {
    return std::nullopt;
  }
  arguments.insert(arguments.begin(), (folder / script).string());
  return Process("/usr/bin/node", arguments, deployment.directory().path());
}

/// The address that the log of the page names.
std::string address(Process& up) {
  std::string found;
  (void)tests::eventually(
      [&] {
        const std::string log = up.errors();
        const std::size_t at = log.find("page at http");
        if (at == std::string::npos || log.find('\n', at) == std::string::npos) return false;
        found = log.substr(at + 8, log.find('\n', at) - at - 8);
        return true;
      },
      60s);
  return found;
}

TEST(Viewer, ABrowserShowsWhatTheServicesPublish) {
  const TestDeployment deployment(services);
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  const std::string url = address(up);
  ASSERT_THAT(url, StartsWith("http://127.0.0.1:")) << up.errors();
  // Kept where a person can look at them.
  const std::filesystem::path pictures = QUOIN_PICTURES_DIR;
  std::filesystem::create_directories(pictures);
  auto browser = client("browser.mjs", {url, pictures.string()}, deployment);
  if (!browser || !std::filesystem::exists("/usr/bin/chromium")) {
    GTEST_SKIP() << "no /usr/bin/chromium, node or tests/npm/node_modules (npm install there)";
  }
  ASSERT_EQ(browser->wait(100s), 0) << browser->errors();
  const json seen = json::parse(browser->output());

  EXPECT_THAT(seen["console"], IsEmpty());
  for (const std::string request : seen["requests"]) EXPECT_THAT(request, StartsWith(url));
  // Each line and corner once in the picture.
  std::size_t lines = 0;
  std::set<std::string> services_seen;
  std::vector<json> corners;
  for (const json& item : seen["items"]) {
    lines += item["kind"] == "line" ? 1 : 0;
    if (item["kind"] == "corner") corners.push_back(item);
    services_seen.insert(item["service"]);
  }
  EXPECT_GT(lines, 10U);
  EXPECT_EQ(seen["svg"]["lines"], lines);
  EXPECT_EQ(services_seen.size(), 4U);
  // The ellipse of each corner, in pixels, is where and what its message says.
  ASSERT_EQ(seen["svg"]["ellipses"].size(), corners.size());
  ASSERT_FALSE(corners.empty());
  const double scale = seen["view"]["scale"];
  const double enlarged = scale * seen["ellipse_scale"].get<double>();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const json& ellipse = seen["svg"]["ellipses"][i];
    const json& view = seen["view"];
    const double x = view["width"].get<double>() / 2 +
                     (corners[i]["world"][0].get<double>() - view["x"].get<double>()) * scale;
    const double y = view["height"].get<double>() / 2 -
                     (corners[i]["world"][1].get<double>() - view["y"].get<double>()) * scale;
    EXPECT_NEAR(ellipse["cx"].get<double>(), x, 0.02);
    EXPECT_NEAR(ellipse["cy"].get<double>(), y, 0.02);
    EXPECT_NEAR(ellipse["rx"].get<double>(), corners[i]["major"].get<double>() * enlarged, 0.02);
    EXPECT_NEAR(ellipse["ry"].get<double>(), corners[i]["minor"].get<double>() * enlarged, 0.02);
    EXPECT_NEAR(ellipse["turn"].get<double>(),
                -corners[i]["direction"].get<double>() * 57.29577951308232, 0.02);
  }
  EXPECT_NE(seen["pixel"], json({251, 251, 250, 255}));  // not the background
  EXPECT_THAT(seen["tip"].get<std::string>(), HasSubstr("ellipse95 major"));
  EXPECT_THAT(seen["tip"].get<std::string>(), HasSubstr("mm"));
  EXPECT_EQ(seen["health"], 7);
  EXPECT_EQ(seen["health_summary"], "7 services, nothing lost");
  EXPECT_THAT(seen["pill"].get<std::string>(), StartsWith("live"));
  EXPECT_EQ(seen["paused"], "paused");
  EXPECT_THAT(seen["answer"].get<std::string>(), HasSubstr("utls"));
  EXPECT_LE(seen["narrow_overflow"], 0);
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
}

TEST(Viewer, FoxglovesOwnClientGetsEveryTopicInBothProtocols) {
  const TestDeployment deployment(services);
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  std::string url = address(up);
  ASSERT_THAT(url, StartsWith("http://127.0.0.1:")) << up.errors();
  url.replace(0, 4, "ws");
  for (const std::string protocol : {"foxglove.websocket.v1", "foxglove.sdk.v1"}) {
    auto foxglove = client("ws_protocol.mjs", {url, "4", protocol}, deployment);
    if (!foxglove) GTEST_SKIP() << "no node or tests/npm/node_modules (npm install there)";
    ASSERT_EQ(foxglove->wait(30s), 0) << foxglove->errors();
    const json seen = json::parse(foxglove->output());
    EXPECT_EQ(seen["subprotocol"], protocol);
    EXPECT_THAT(seen["errors"], IsEmpty());
    EXPECT_THAT(seen["statuses"], IsEmpty());  // nothing was dropped
    const std::string name = deployment.deployment().name_space;
    EXPECT_EQ(seen["channels"][name + "/front/scan"]["schemaEncoding"], "omgidl");
    EXPECT_EQ(seen["channels"][name + "/utls_corners/corners/scene"]["schema"],
              "foxglove.SceneUpdate");
    for (const char* topic :
         {"/front/scan", "/walls/segments", "/utls/lines", "/wctls_corners/corners",
          "/utls_corners/corners/scene", "/transforms", "/status"}) {
      EXPECT_GT(seen["messages"][name + topic]["count"], 2) << topic;
    }
  }
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
}

TEST(Viewer, BehindClosedDoorsItShowsEverythingAndAsksNobody) {
  const TestDeployment deployment(services, "security: {keys: keys}\n");
  tests::make_keys(deployment);
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  std::string url = address(up);
  ASSERT_THAT(url, StartsWith("http://127.0.0.1:")) << up.errors();
  url.replace(0, 4, "ws");
  auto foxglove = client("ws_protocol.mjs", {url, "4", "foxglove.sdk.v1"}, deployment);
  if (!foxglove) GTEST_SKIP() << "no node or tests/npm/node_modules (npm install there)";
  ASSERT_EQ(foxglove->wait(30s), 0) << foxglove->errors();
  const json seen = json::parse(foxglove->output());
  const std::string name = deployment.deployment().name_space;
  for (const char* topic : {"/front/scan", "/wctls_corners/corners", "/status"}) {
    EXPECT_GT(seen["messages"][name + topic]["count"], 2) << topic;
  }
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
}

TEST(Viewer, AReplayIsSteppedByTheCommandAndByThePage) {
  const TestDeployment deployment(R"(
  - {name: tape, kind: replay, parameters: {path: scans.csv, loop: true, paused: true, speed: 0}}
  - {name: walls, kind: segmentation, input: tape}
  - {name: page, kind: viewer, inputs: all, parameters: {port: 0}}
)");
  deployment.directory().write("scans.csv", "bearing,range\n0,1\n0.1,1\n");
  runtime::Participant participant(deployment.participant("test"));
  tests::StatusRecorder status(participant, deployment);
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  std::string url = address(up);
  ASSERT_THAT(url, StartsWith("http://127.0.0.1:")) << up.errors();
  url.replace(0, 4, "ws");
  const auto published = [&](std::uint64_t count) {
    return status.wait_for("tape", [&](const msg::ServiceStatus& heartbeat) {
      return heartbeat.published() == count && heartbeat.state() == msg::ServiceState::STATE_ACTIVE;
    });
  };
  EXPECT_TRUE(published(0)) << "it begins paused";
  Process stepped = deployment.quoin({"playback", "step", "tape", "3", "--deployment", "FILE"});
  ASSERT_EQ(stepped.wait(20s), 0) << stepped.errors();
  EXPECT_THAT(stepped.output(), StartsWith("tape: paused=true speed=0"));
  EXPECT_TRUE(published(3));
  Process wrong = deployment.quoin({"set", "tape", "pace=3", "--deployment", "FILE"});
  EXPECT_EQ(wrong.wait(20s), 2);
  EXPECT_THAT(wrong.errors(), HasSubstr("pace"));

  auto page = client("service_call.mjs",
                     {url, "playback", R"({"step": 2})", "playback",
                      R"({"step": 1, "service": "walls"})", "playback", R"({"stop": true})"},
                     deployment);
  if (!page) GTEST_SKIP() << "no node or tests/npm/node_modules (npm install there)";
  ASSERT_EQ(page->wait(30s), 0) << page->errors();
  const json answers = json::parse(page->output())["answers"];
  EXPECT_EQ(answers[0], json({{"asked", {"tape"}}}));
  EXPECT_THAT(answers[1].get<std::string>(), HasSubstr("'walls' is no replay"));
  EXPECT_THAT(answers[2].get<std::string>(), HasSubstr("neither paused, step nor speed"));
  EXPECT_TRUE(published(5));
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
}

TEST(Viewer, ViewShowsARunningDeploymentAndExplainAnswersOfIt) {
  const TestDeployment deployment(services);
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  Process view = deployment.quoin({"view", "FILE", "--port", "0"});
  ASSERT_TRUE(tests::eventually([&] { return view.output().find('\n') != std::string::npos; }, 30s))
      << view.errors();
  EXPECT_THAT(view.output(), StartsWith("http://127.0.0.1:"));
  // The corner of this room at 3, 2.2 m or so: whatever is there, it is said.
  Process explain = deployment.quoin(
      {"explain", "FILE", "--service", "utls", "--at", "10 deg", "--json", "--wait", "40"});
  ASSERT_EQ(explain.wait(60s), 0) << explain.errors();
  const json answer = json::parse(explain.output());
  EXPECT_EQ(answer["service"], "utls");
  EXPECT_EQ(answer["segmentation"]["method"], "iepf");
  EXPECT_GT(answer["points"], 0);
  view.signal(SIGINT);
  EXPECT_EQ(view.wait(30s), 0) << view.errors();
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
}

TEST(Viewer, APortInUseIsAnErrorOfTheConfiguration) {
  const TestDeployment deployment(services);
  Process first = deployment.quoin({"view", "FILE", "--port", "0"});
  ASSERT_TRUE(
      tests::eventually([&] { return first.output().find('\n') != std::string::npos; }, 30s));
  const std::string url = first.output();
  const std::size_t colon = url.rfind(':', url.find('\n'));
  const std::string port = url.substr(colon + 1, url.find('/', colon) - colon - 1);
  Process second = deployment.quoin({"view", "FILE", "--port", port});
  EXPECT_NE(second.wait(20s), 0);
  EXPECT_THAT(second.errors(), HasSubstr("port " + port));
  Process wrong = deployment.quoin({"explain", "FILE", "--service", "front", "--at", "1,2"});
  EXPECT_EQ(wrong.wait(20s), 2);
  EXPECT_THAT(wrong.errors(), HasSubstr("line_fitting"));
  Process nowhere = deployment.quoin({"explain", "FILE", "--service", "utls", "--at", "north"});
  EXPECT_EQ(nowhere.wait(20s), 2);
}

}  // namespace
}  // namespace quoin
