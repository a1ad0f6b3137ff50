// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <filesystem>
#include <fstream>
#include <idl/Segments.h>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/leftovers.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::Process;
using tests::processes_naming;
using tests::shared_memory_files;
using tests::StatusRecorder;
using tests::TestDeployment;

std::string chain(const std::string& source_parameters) {
  return "  - {name: front, kind: simulated, parameters: {" + source_parameters +
         "}}\n"
         "  - {name: walls, kind: segmentation, input: front, method: iepf}\n"
         "  - {name: wctls, kind: line_fitting, input: walls, method: wctls}\n"
         "  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}\n";
}

/// Whether another process of the service than that of `before` publishes, and has for a second.
bool is_back(StatusRecorder& status, const std::string& service, std::uint64_t before) {
  return status.wait_for(
      service, [&](const auto& s) { return s.incarnation() != before && s.published() > 50; });
}

TEST(Up, RunsAFiniteSourceToItsEndAndSumsUp) {
  const TestDeployment deployment(chain("rate_hz: 50, scans: 200"));
  Process up = deployment.quoin({"up", "FILE", "--json"});
  ASSERT_EQ(up.wait(60s), 0) << up.errors();
  const json result = json::parse(up.output());
  EXPECT_EQ(result["scans_published"], 200);
  for (const char* name : {"walls", "wctls", "corners"}) {
    SCOPED_TRACE(name);
    const json& service = result["services"][name];
    EXPECT_EQ(service["received"], 200);
    EXPECT_EQ(service["published"], 200);
    EXPECT_EQ(service["lost"], 0);
    EXPECT_EQ(service["restarts"], 0);
    EXPECT_GT(service["latency_p50_us"], 0.0);
    EXPECT_GE(service["latency_p99_us"], service["latency_p50_us"]);
    EXPECT_GT(service["resident_memory_bytes"], 1'000'000);
  }
  const json& corners = result["corners"]["corners"];
  EXPECT_EQ(corners["scans_expected"], 200);
  EXPECT_EQ(corners["scans_delivered"], 200);
  EXPECT_EQ(corners["scans_lost"], 0);
  EXPECT_GT(corners["mean_corners"], 4.0);
  EXPECT_GT(corners["median_sigma_mm"], 0.1);
  EXPECT_LT(corners["median_sigma_mm"], 50.0);
  EXPECT_GT(corners["median_ellipse_area_mm2"], 1.0);
}

TEST(Up, EndsAfterItsDuration) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  Process up = deployment.quoin({"up", "FILE", "--json", "--duration", "2"});
  ASSERT_EQ(up.wait(60s), 0) << up.errors();
  const json result = json::parse(up.output());
  const auto published = result["scans_published"].get<int>();
  EXPECT_GT(published, 0);
  EXPECT_EQ(result["corners"]["corners"]["scans_delivered"], published)
      << "what was in flight has arrived";
  EXPECT_EQ(result["corners"]["corners"]["scans_lost"], 0);
}

TEST(Up, CtrlCLeavesNothingBehind) {
  const auto shared_memory = shared_memory_files();
  const TestDeployment deployment(chain("rate_hz: 50"));
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process up = deployment.quoin({"up", "FILE"});
  ASSERT_TRUE(status.wait_for("corners", [](const auto& s) { return s.published() > 10; }));
  EXPECT_EQ(processes_naming(deployment.file()).size(), 5U) << "quoin and four services";
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
  EXPECT_THAT(processes_naming(deployment.file()), IsEmpty());
  EXPECT_THAT(shared_memory_files(), testing::IsSubsetOf(shared_memory));
}

TEST(Up, NoServiceOutlivesAKilledQuoin) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  ASSERT_TRUE(status.wait_for("corners", [](const auto& s) { return s.published() > 10; }));
  up.signal(SIGKILL);
  EXPECT_EQ(up.wait(10s), 128 + SIGKILL);
  EXPECT_TRUE(tests::eventually([&] { return processes_naming(deployment.file()).empty(); }));
}

TEST(Up, WaitsForTheServicesOfAKilledOne) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process killed = deployment.quoin({"up", "FILE", "--quiet"});
  ASSERT_TRUE(status.wait_for("corners", [](const auto& s) { return s.published() > 10; }));
  const std::uint64_t before = status.latest("corners").incarnation();
  // A service that takes its time.
  ASSERT_EQ(kill(static_cast<pid_t>(status.latest("walls").pid()), SIGSTOP), 0);
  killed.signal(SIGKILL);
  EXPECT_EQ(killed.wait(10s), 128 + SIGKILL);
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  EXPECT_EQ(up.wait(1s), std::nullopt);
  EXPECT_EQ(status.latest("corners").incarnation(), before) << "nothing is started";
  ASSERT_EQ(kill(static_cast<pid_t>(status.latest("walls").pid()), SIGCONT), 0);
  EXPECT_TRUE(status.wait_for(
      "corners", [&](const auto& s) { return s.incarnation() != before && s.published() > 10; }));
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
  EXPECT_THAT(up.errors(), testing::Not(HasSubstr("also runs as")));
}

TEST(Up, AKilledServiceIsStartedAgainAndTheLossIsShown) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process up = deployment.quoin({"up", "FILE", "--json"});
  ASSERT_TRUE(status.wait_for("corners", [](const auto& s) { return s.published() > 50; }));
  const auto first = status.latest("walls");
  ASSERT_EQ(kill(static_cast<pid_t>(first.pid()), SIGKILL), 0);
  ASSERT_TRUE(is_back(status, "walls", first.incarnation()));
  up.signal(SIGINT);
  ASSERT_EQ(up.wait(30s), 0) << up.errors();
  EXPECT_THAT(up.errors(), HasSubstr("walls"));
  const json result = json::parse(up.output());
  EXPECT_EQ(result["services"]["walls"]["restarts"], 1);
  const json& corners = result["corners"]["corners"];
  EXPECT_EQ(corners["scans_delivered"].get<int>() + corners["scans_lost"].get<int>(),
            corners["scans_expected"].get<int>());
  EXPECT_GT(corners["lost_by_stage"]["walls"], 0);
}

TEST(Up, AHungServiceHoldsUpARestartedOneForAShortTimeOnly) {
  const TestDeployment deployment(
      chain("rate_hz: 50") + "  - {name: utls, kind: line_fitting, input: walls, method: utls}\n");
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process up = deployment.quoin({"up", "FILE"});
  ASSERT_TRUE(status.wait_for("corners", [](const auto& s) { return s.published() > 50; }));
  ASSERT_TRUE(status.wait_for("utls", [](const auto& s) { return s.published() > 50; }));
  const auto hung = static_cast<pid_t>(status.latest("utls").pid());
  const auto walls = status.latest("walls");
  ASSERT_EQ(kill(hung, SIGSTOP), 0);
  ASSERT_EQ(kill(static_cast<pid_t>(walls.pid()), SIGKILL), 0);
  ASSERT_TRUE(is_back(status, "walls", walls.incarnation()));
  ASSERT_EQ(kill(hung, SIGCONT), 0);
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(30s), 0) << up.errors();
  EXPECT_THAT(up.errors(), HasSubstr("readers are there after 2 s; going on"));
}

TEST(Up, CountsTheScansOfASourceThatLivedAndDiedWhileAReaderHeardNothing) {
  const TestDeployment deployment(
      chain("rate_hz: 50") +
      "  - {name: utls, kind: line_fitting, input: walls, method: utls}\n"
      "  - {name: more_corners, kind: corner_estimation, input: utls, method: adjacent}\n");
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process up = deployment.quoin({"up", "FILE", "--json"});
  const auto kill_newest = [&](const std::string& service, int signal) {
    ASSERT_EQ(kill(static_cast<pid_t>(status.latest(service).pid()), signal), 0);
  };
  for (const char* name : {"corners", "more_corners"}) {
    ASSERT_TRUE(status.wait_for(name, [](const auto& s) { return s.published() > 50; }));
  }

  kill_newest("more_corners", SIGSTOP);
  for (int killed = 0; killed < 2; ++killed) {
    const std::uint64_t front = status.latest("front").incarnation();
    kill_newest("front", SIGKILL);
    ASSERT_TRUE(is_back(status, "front", front));
  }
  // Nor do the stages that lived all the time, by the numbers of their results, tell what was made.
  const std::uint64_t corners = status.latest("more_corners").incarnation();
  for (const char* service : {"walls", "utls", "more_corners"}) kill_newest(service, SIGKILL);
  ASSERT_TRUE(is_back(status, "more_corners", corners));

  up.signal(SIGINT);
  ASSERT_EQ(up.wait(30s), 0) << up.errors();
  const json result = json::parse(up.output());
  for (const char* name : {"corners", "more_corners"}) {
    const json& seen = result["corners"][name];
    EXPECT_GT(seen["scans_lost"], 0) << seen;
    EXPECT_EQ(seen["scans_expected"], result["scans_published"]) << seen;
  }
}

/// What `quoin doctor` finds, by check.
std::multimap<std::string, std::string> findings(const TestDeployment& deployment) {
  Process doctor = deployment.quoin({"doctor", "FILE", "--json"});
  EXPECT_TRUE(doctor.wait(30s)) << doctor.errors();
  const json report = json::parse(doctor.output());
  std::multimap<std::string, std::string> texts;
  for (const json& check : report["checks"]) {
    if (check["verdict"] == "ok") continue;
    EXPECT_NE(check["advice"], "");
    texts.emplace(check["check"], check["text"]);
  }
  return texts;
}

/// The same, once it finds something of `check`: a host that is busy hears little in its time.
std::multimap<std::string, std::string> findings(const TestDeployment& deployment,
                                                 const std::string& check) {
  std::multimap<std::string, std::string> found;
  EXPECT_TRUE(tests::eventually([&] {
    found = findings(deployment);
    return found.contains(check);
  }));
  return found;
}

TEST(Status, TellsWhatRunsAndWhoDoesNotFitToWhom) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  runtime::Participant participant(deployment.participant("visitor"));
  StatusRecorder status(participant, deployment);
  ASSERT_TRUE(status.wait_for("corners", [](const auto& s) { return s.published() > 10; }));
  const runtime::Reader<msg::Segments> visitor(participant, deployment.topic("walls"),
                                               runtime::QosPreset::state);
  ASSERT_TRUE(
      status.wait_for("walls", [](const auto& s) { return !s.incompatible_qos().empty(); }));

  // Without a file: all namespaces of the domain, of which other tests may have some.
  const std::string domain = std::to_string(deployment.deployment().domain);
  json walls;
  ASSERT_TRUE(tests::eventually([&] {
    Process listing = deployment.quoin({"status", "--domain", domain, "--json"});
    EXPECT_TRUE(listing.wait(20s)) << listing.errors();
    const json listed = json::parse(listing.output());
    for (const json& service : listed["services"]) {
      const bool ours = service["namespace"] == deployment.deployment().name_space;
      if (ours && service["kind"] == "segmentation") walls = service;
    }
    return !walls.is_null();
  }));
  const std::string mismatch = deployment.topic("walls") +
                               ": durability: walls offers volatile, visitor requests "
                               "transient-local";
  EXPECT_EQ(walls["incompatible_qos"], json::array({mismatch}));
  EXPECT_EQ(walls["state"], "active");
  EXPECT_EQ(walls["method"], "iepf");
  EXPECT_EQ(walls["dds"], runtime::dds_version());
  EXPECT_GE(walls["age_s"], 0.0);
  EXPECT_LT(walls["age_s"], 30.0);
  Process table = deployment.quoin({"status", "FILE"});
  ASSERT_EQ(table.wait(20s), 0) << table.errors();
  EXPECT_THAT(table.output(), HasSubstr("walls: incompatible QoS: " + mismatch));
  EXPECT_THAT(table.output(),
              HasSubstr("Quoin " + walls["version"].get<std::string>() + " with " +
                        std::string(runtime::dds_version()) + ": front, walls, wctls, corners\n"));

  // One whose heartbeats have other fields.
  runtime::TopicQos other = runtime::QosPreset::state;
  other.user_data = "quoin type 0badf00d;";
  const runtime::Writer<msg::ServiceStatus> newer(
      participant, status_topic(deployment.deployment().name_space), other);
  const std::string named = "visitor offers quoin::msg::ServiceStatus with the fields 0badf00d";
  ASSERT_TRUE(tests::eventually([&] {
    Process again = deployment.quoin({"status", "FILE"});
    EXPECT_EQ(again.wait(20s), 0) << again.errors();
    return again.output().find(named) != std::string::npos;
  }));
  EXPECT_THAT(findings(deployment, "QoS"),
              testing::Contains(testing::Pair("QoS", HasSubstr(named))));

  const auto found = findings(deployment, "QoS");
  EXPECT_THAT(found, testing::Contains(testing::Pair("QoS", HasSubstr(mismatch))));
  EXPECT_THAT(found, testing::Not(testing::Contains(testing::Key("deployments"))));
  const Process second = deployment.start("walls");
  ASSERT_TRUE(status.wait_for(
      "walls", [&](const auto& s) { return static_cast<pid_t>(s.pid()) == second.pid(); }));
  EXPECT_THAT(
      findings(deployment, "deployments"),
      testing::Contains(testing::Pair("deployments", HasSubstr("/walls runs more than once"))));
}

TEST(Status, SaysHowMuchLinesScatter) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  json scatter;
  ASSERT_TRUE(tests::eventually([&] {
    Process listing = deployment.quoin({"status", "FILE", "--json"});
    EXPECT_TRUE(listing.wait(20s)) << listing.errors();
    const json services = json::parse(listing.output())["services"];
    scatter = services.value("wctls", json::object()).value("line_scatter", json());
    return !scatter.is_null() && scatter["lines"] >= 400;
  }));
  // The simulated sensor declares its noise truly.
  EXPECT_NEAR(scatter["reduced_chi_square"].get<double>(), 1.0, 0.15);
  EXPECT_LT(scatter["reduced_chi_square_interval"][0], scatter["reduced_chi_square_interval"][1]);
  EXPECT_GT(scatter["odd_even_lines"], 10);
  EXPECT_GT(scatter["odd_even_inside95"], 0.8);
  EXPECT_EQ(scatter["complaint"], "");
}

TEST(Echo, PrintsTheMessagesOfAService) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  for (const char* service : {"front", "walls", "wctls", "corners"}) {
    SCOPED_TRACE(service);
    Process echo = deployment.quoin({"echo", "FILE", service, "--count", "2", "--json"});
    ASSERT_EQ(echo.wait(30s), 0) << echo.errors();
    std::istringstream lines(echo.output());
    std::string line;
    int count = 0;
    while (std::getline(lines, line)) {
      EXPECT_TRUE(json::accept(line));
      ++count;
    }
    EXPECT_EQ(count, 2);
  }
}

TEST(Draw, MakesAPictureOfARunningDeployment) {
  const TestDeployment deployment(chain("rate_hz: 50"));
  const auto picture = deployment.directory().path() / "scan.svg";
  Process draw =
      deployment.quoin({"draw", "FILE", "--service", "corners", "-o", picture.string(), "--run"});
  ASSERT_EQ(draw.wait(60s), 0) << draw.errors();
  std::ifstream file(picture);
  const std::string svg((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
}

}  // namespace
}  // namespace quoin
