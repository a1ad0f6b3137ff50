// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/runtime/dds/endpoints.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/hosts.hpp"
#include "tests/integration/harness/keys.hpp"
#include "tests/integration/harness/leftovers.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using namespace std::string_literals;
using nlohmann::json;
using tests::Hosts;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

constexpr int rate_hz = 20;
// [s] Five, and one more since the last heartbeat may be that old.
constexpr int longest_cut = 6;
constexpr int scans_of_a_cut = longest_cut * rate_hz;

const char* const chain = R"(
  - {name: front, kind: simulated, host: lidar, parameters: {rate_hz: 20}}
  - {name: walls, kind: segmentation, input: front, host: compute}
  - {name: lines, kind: line_fitting, input: walls, host: compute}
  - {name: corners, kind: corner_estimation, input: lines, host: base}
)";

pid_t parent_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string word; file >> word;) {
    pid_t parent = 0;
    if (word == "PPid:" && file >> parent) return parent;
  }
  return 0;
}

/// A chain of services over three hosts, watched from the host `base`.
class Robot {
 public:
  explicit Robot(const std::string& head, const std::string& lossy = "",
                 const std::string& services = chain)
      : hosts_({"lidar", "compute", "base"}, lossy),
        deployment_(services, head),
        participant_(take_part()),
        status_(participant_, deployment_) {}

  [[nodiscard]] const Hosts& hosts() const { return hosts_; }
  [[nodiscard]] const TestDeployment& deployment() const { return deployment_; }
  [[nodiscard]] const msg::ServiceStatus& latest(const std::string& service) {
    return status_.latest(service);
  }

  void up(const std::string& host) {
    ups_[host] = hosts_.on(host, [&] {
      return std::make_unique<Process>(deployment_.quoin({"up", "FILE", "--host", host, "--json"}));
    });
  }

  /// True once `service` runs as another process than that of `incarnation`.
  [[nodiscard]] bool has_restarted(const std::string& service, std::uint64_t incarnation) {
    return status_.wait_for(
        service,
        [&](const auto& status) {
          return status.incarnation() != incarnation && status.state() == msg::STATE_ACTIVE;
        },
        40s);
  }

  [[nodiscard]] Process quoin(const std::string& host, std::vector<std::string> arguments) const {
    return hosts_.on(host, [&] { return deployment_.quoin(std::move(arguments)); });
  }

  /// True once the present process of `service` has published that many.
  [[nodiscard]] bool has_published(const std::string& service, std::uint64_t count) {
    return status_.wait_for(
        service, [&](const auto& status) { return status.published() >= count; }, 40s);
  }

  /// Cuts the link of `host` for as long as the source takes for these scans.
  [[nodiscard]] bool cut_for_five_seconds(const std::string& host, int scans = scans_of_a_cut) {
    hosts_.cut(host);
    const bool published = has_published("front", latest("front").published() + scans);
    hosts_.mend(host);
    return published;
  }

  /// Kills all that runs on `host`, as a power failure would.
  void lose_power(const std::string& host) {
    ups_.at(host)->signal(SIGKILL);
    for (const auto& service : deployment_.deployment().services) {
      if (service.host != host) continue;
      kill(static_cast<pid_t>(latest(service.name).pid()), SIGKILL);
    }
    EXPECT_EQ(ups_.at(host)->wait(10s), 128 + SIGKILL);
  }

  /// Ends what runs on `host`; the figures of its share.
  json stop(const std::string& host) {
    Process& process = *ups_.at(host);
    process.signal(SIGINT);
    EXPECT_EQ(process.wait(30s), 0) << process.errors();
    return json::parse(process.output(), nullptr, false);
  }

  /// Ends everything, the source first, and checks that each scan came out at the end or is counted
  /// as lost; the figures of the corner services.
  json stop_all() {
    const auto published = stop("lidar").value("scans_published", 0U);
    stop("compute");
    json base = stop("base");
    EXPECT_GT(published, 0U);
    EXPECT_EQ(base["scans_published"], published);
    for (const auto& [name, corners] : base["corners"].items()) {
      EXPECT_EQ(corners["scans_delivered"].get<unsigned>() + corners["scans_lost"].get<unsigned>(),
                published)
          << name << ": " << corners;
    }
    return base["corners"];
  }

  /// What the hosts have said so far.
  [[nodiscard]] std::string logs() const {
    std::string text;
    for (const auto& [host, up] : ups_) text += host + ":\n" + up->errors();
    return text;
  }

  /// The process that `quoin up` of `host` has started for the discovery server there.
  [[nodiscard]] pid_t discovery_server(const std::string& host) const {
    for (const pid_t process : tests::processes_naming("quoin\0discovery\0"s)) {
      if (parent_of(process) == ups_.at(host)->pid()) return process;
    }
    return 0;
  }

 private:
  [[nodiscard]] runtime::ParticipantConfig take_part() const {
    if (!deployment_.deployment().security) return deployment_.participant("test");
    tests::make_keys(deployment_);
    return deployment_.participant(std::string(operator_identity));
  }

  Hosts hosts_;
  TestDeployment deployment_;
  runtime::Participant participant_;
  StatusRecorder status_;
  std::map<std::string, std::unique_ptr<Process>> ups_;
};

class Network : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = Hosts::refusal()) GTEST_SKIP() << "skipped: " << *why;
  }
};

TEST_F(Network, MulticastStaysOnTheNamedInterfacesAndLosslessLosesNothingInACutOfFiveSeconds) {
  Robot robot("network: {interfaces: eth0, discovery: multicast}\nqos: lossless\n");
  for (const char* host : {"lidar", "compute", "base"}) robot.up(host);
  ASSERT_TRUE(robot.has_published("corners", 20));

  ASSERT_TRUE(robot.cut_for_five_seconds("compute"));
  ASSERT_TRUE(robot.has_published("corners", robot.latest("front").published() + 20));

  // Commands find the services without the file, too.
  const auto& deployment = robot.deployment().deployment();
  Process status = robot.quoin("compute", {"status", "--domain", std::to_string(deployment.domain),
                                           "--namespace", deployment.name_space, "--interface",
                                           "eth0", "--discovery", "multicast", "--json"});
  EXPECT_EQ(status.wait(20s), 0) << status.errors();
  const json heard = json::parse(status.output(), nullptr, false);
  EXPECT_EQ(heard["services"].size(), 4U) << heard;

  const json corners = robot.stop_all()["corners"];
  EXPECT_EQ(corners["scans_lost"], 0) << corners;
  for (const char* host : {"lidar", "compute", "base"}) {
    EXPECT_GT(robot.hosts().frames(host, "eth0"), 0U);
    EXPECT_EQ(robot.hosts().frames(host, "aux0"), 0U) << host;
  }
}

TEST_F(Network, WithPeersALateHostACutAndAPowerFailureAreCaughtUpWithAndEachScanIsAccountedFor) {
  Robot robot(
      "network: {interfaces: 10.77.0.0/24, peers: [10.77.0.1, 10.77.0.2, 10.77.0.3], lease: 4 "
      "s}\n");
  robot.up("base");
  robot.up("lidar");
  // The source does not wait for ever for the host between.
  ASSERT_TRUE(robot.has_published("front", 1));
  robot.up("compute");
  ASSERT_TRUE(robot.has_published("corners", 20));

  // Longer than the lease: all of them have forgotten each other when the link is back.
  ASSERT_TRUE(robot.cut_for_five_seconds("compute"));
  ASSERT_TRUE(robot.has_published("corners", robot.latest("corners").published() + 20));
  Process status = robot.quoin("lidar", {"status", "FILE", "--json"});
  EXPECT_EQ(status.wait(20s), 0) << status.errors();
  const json heard = json::parse(status.output(), nullptr, false);
  EXPECT_GT(heard["services"]["walls"]["lost"], scans_of_a_cut / 2) << heard;

  const auto walls = robot.latest("walls").incarnation();
  robot.lose_power("compute");
  robot.up("compute");
  ASSERT_TRUE(robot.has_published("corners", robot.latest("corners").published() + 40));
  EXPECT_NE(robot.latest("walls").incarnation(), walls);

  const json corners = robot.stop_all()["corners"];
  EXPECT_GT(corners["lost_at_start"], 0) << corners;
  EXPECT_GT(corners["lost_by_stage"]["walls"], scans_of_a_cut / 2) << corners;
}

TEST_F(Network, OneOfTwoDiscoveryServersSuffices) {
  Robot robot("network: {interfaces: eth0, servers: [10.77.0.1, 10.77.0.3], lease: 3 s}\n");
  for (const char* host : {"lidar", "compute", "base"}) robot.up(host);
  ASSERT_TRUE(robot.has_published("corners", 10));
  const pid_t first = robot.discovery_server("lidar");
  const pid_t second = robot.discovery_server("base");
  ASSERT_GT(first, 0);
  ASSERT_GT(second, 0);
  EXPECT_EQ(robot.discovery_server("compute"), 0);

  ASSERT_EQ(kill(first, SIGKILL), 0);
  Process echo = robot.quoin("compute", {"echo", "FILE", "corners", "--count", "2", "--json"});
  EXPECT_EQ(echo.wait(30s), 0) << echo.errors();

  ASSERT_TRUE(tests::eventually([&] {
    const pid_t again = robot.discovery_server("lidar");
    return again > 0 && again != first;
  }));
  ASSERT_EQ(kill(second, SIGSTOP), 0);  // killed it would come back
  Process echo_again = robot.quoin("compute", {"echo", "FILE", "front", "--count", "2", "--json"});
  EXPECT_EQ(echo_again.wait(30s), 0) << echo_again.errors();
  ASSERT_EQ(kill(second, SIGCONT), 0);

  EXPECT_EQ(robot.stop_all()["corners"]["scans_lost"], 0);
}

TEST_F(Network, LosslessLosesNothingOnLinksThatLoseAndDelay) {
  if (const auto why = Hosts::refusal(true)) GTEST_SKIP() << "skipped: " << *why;
  Robot robot("network: {interfaces: eth0}\nqos: lossless\n", "compute");
  for (const char* host : {"lidar", "compute", "base"}) robot.up(host);
  ASSERT_TRUE(robot.has_published("corners", 10));
  const std::pair<double, std::chrono::milliseconds> impairments[] = {
      {0.01, 0ms}, {0.05, 0ms}, {0.05, 50ms}};
  for (const auto& [loss, delay] : impairments) {
    robot.hosts().impair(loss, delay);
    ASSERT_TRUE(robot.has_published("corners", robot.latest("corners").published() + 2 * rate_hz))
        << loss << ", " << delay.count() << " ms";
  }
  robot.hosts().impair(0.0, 0ms);
  const json corners = robot.stop_all()["corners"];
  EXPECT_EQ(corners["scans_lost"], 0) << corners << robot.logs();
  // Of those that lack one the kernel keeps the others for half a minute, instead of new scans.
  for (const char* host : {"lidar", "compute", "base"}) {
    EXPECT_EQ(robot.hosts().fragments(host), 0U) << host;
  }
}

TEST_F(Network, ApplyChangesTheShareOfTheHostThatIsNamed) {
  Robot robot("network: {interfaces: eth0}\nqos: lossless\n");
  for (const char* host : {"lidar", "compute", "base"}) robot.up(host);
  ASSERT_TRUE(robot.has_published("corners", 10));
  const auto lines = robot.latest("lines").incarnation();
  const std::string changed = robot.deployment().write("changed.yaml", R"(
  - {name: front, kind: simulated, host: lidar, parameters: {rate_hz: 20}}
  - {name: walls, kind: segmentation, input: front, host: compute}
  - {name: lines, kind: line_fitting, input: walls, method: utls, host: compute}
  - {name: beside, kind: line_fitting, input: walls, method: pca, host: compute}
  - {name: corners, kind: corner_estimation, input: lines, host: base}
)");
  const auto actions_on = [&](const std::string& host) {
    Process apply = robot.quoin("lidar", {"apply", changed, "--host", host, "--json"});
    EXPECT_EQ(apply.wait(30s), 0) << apply.errors();
    std::map<std::string, std::string> actions;
    const json outcome = json::parse(apply.output(), nullptr, false);
    for (const json& step : outcome["steps"]) {
      actions[step["service"]] = step["action"];
    }
    return actions;
  };
  using Actions = std::map<std::string, std::string>;
  EXPECT_EQ(actions_on("compute"),
            (Actions{{"walls", "keep"}, {"lines", "swap"}, {"beside", "start"}}));
  ASSERT_TRUE(robot.has_published("beside", 10));
  EXPECT_EQ(robot.latest("lines").method(), "utls");
  EXPECT_EQ(robot.latest("lines").incarnation(), lines);
  EXPECT_EQ(actions_on("base"), (Actions{{"corners", "keep"}}));
  EXPECT_EQ(robot.stop_all()["corners"]["scans_lost"], 0);
}

/// What `quoin apply FILE --json` of the host `lidar` has told.
json apply(Robot& robot, const std::string& file, int exit_code) {
  Process apply = robot.quoin("lidar", {"apply", file, "--json"});
  EXPECT_EQ(apply.wait(60s), exit_code) << apply.errors() << robot.logs();
  return json::parse(apply.output(), nullptr, false);
}

/// "host action service" of each step.
std::vector<std::string> steps_of(const json& outcome) {
  std::vector<std::string> steps;
  for (const json& step : outcome["steps"]) {
    steps.push_back(step["host"].get<std::string>() + " " + step["action"].get<std::string>() +
                    " " + step["service"].get<std::string>());
  }
  return steps;
}

TEST_F(Network, ApplyChangesAllHostsTogetherAndLosesNothing) {
  Robot robot("network: {interfaces: eth0}\nqos: lossless\n");
  for (const char* host : {"lidar", "compute", "base"}) robot.up(host);
  ASSERT_TRUE(robot.has_published("corners", 10));
  // Each replaced process reads what another host starts: no host could do its share alone.
  const json outcome = apply(robot, robot.deployment().write("rewired.yaml", R"(
  - {name: front, kind: simulated, host: lidar, parameters: {rate_hz: 20}}
  - {name: fine, kind: segmentation, input: front, method: hierarchical, host: base}
  - {name: lines, kind: line_fitting, input: fine, host: compute}
  - {name: others, kind: line_fitting, input: fine, method: utls, host: lidar}
  - {name: corners, kind: corner_estimation, input: others, host: base}
)"),
                             0);
  EXPECT_THAT(steps_of(outcome),
              testing::UnorderedElementsAre("lidar keep front", "lidar start others",
                                            "compute replace lines", "compute stop walls",
                                            "base start fine", "base replace corners"));
  ASSERT_TRUE(robot.has_published("corners", 10));
  EXPECT_EQ(robot.stop_all()["corners"]["scans_lost"], 0);
}

// Another method on the host `compute` twice, and a fitter more.
const char* const retuned_chain = R"(
  - {name: front, kind: simulated, host: lidar, parameters: {rate_hz: 20}}
  - {name: walls, kind: segmentation, input: front, method: hierarchical, host: compute}
  - {name: lines, kind: line_fitting, input: walls, method: utls, host: compute}
  - {name: beside, kind: line_fitting, input: walls, method: pca, host: compute}
  - {name: corners, kind: corner_estimation, input: lines, host: base}
)";

TEST_F(Network, WhenOneHostCannotApplyNoHostChanges) {
  Robot robot("network: {interfaces: eth0}\nqos: lossless\n");
  for (const char* host : {"lidar", "compute"}) robot.up(host);
  const std::string retuned = robot.deployment().write("retuned.yaml", retuned_chain);
  Process early = robot.quoin("lidar", {"apply", retuned, "--wait", "2"});
  EXPECT_EQ(early.wait(20s), 1);
  EXPECT_THAT(early.errors(), testing::HasSubstr("on host base"));

  robot.up("base");
  ASSERT_TRUE(robot.has_published("corners", 10));
  const auto lines = robot.latest("lines").incarnation();
  // The recording is not there, which only its process on the host `base` can find out.
  const json outcome = apply(
      robot,
      robot.deployment().write(
          "missing.yaml",
          std::string(retuned_chain) +
              "  - {name: rear, kind: replay, parameters: {path: nowhere.csv}, host: base}\n"),
      1);
  EXPECT_EQ(outcome["rolled_back"], true);
  EXPECT_THAT(outcome["detail"].get<std::string>(), testing::HasSubstr("nowhere.csv"));
  ASSERT_TRUE(robot.has_published("lines", robot.latest("lines").published() + 40));
  EXPECT_EQ(robot.latest("lines").incarnation(), lines);
  EXPECT_EQ(robot.latest("lines").method(), "inverse_range");
  EXPECT_EQ(robot.latest("walls").method(), "iepf");
  EXPECT_EQ(robot.stop_all()["corners"]["scans_lost"], 0);
}

TEST_F(Network, AnInterruptedApplyIsDoneEverywhereOrNowhere) {
  Robot robot("network: {interfaces: eth0}\nqos: lossless\n");
  for (const char* host : {"lidar", "compute", "base"}) robot.up(host);
  ASSERT_TRUE(robot.has_published("corners", 10));
  Process apply =
      robot.quoin("lidar", {"apply", robot.deployment().write("retuned.yaml", retuned_chain)});
  ASSERT_TRUE(
      tests::eventually([] { return !tests::processes_naming("--service\0beside\0"s).empty(); }));
  apply.signal(SIGINT);
  const auto exit_code = apply.wait(60s);
  ASSERT_TRUE(exit_code.has_value());
  const bool done = *exit_code == 0;
  ASSERT_TRUE(robot.has_published("lines", robot.latest("lines").published() + 40));
  EXPECT_EQ(robot.latest("lines").method(), done ? "utls" : "inverse_range") << apply.errors();
  EXPECT_EQ(robot.latest("walls").method(), done ? "hierarchical" : "iepf");
  EXPECT_EQ(robot.stop_all()["corners"]["scans_lost"], 0);
}

/// The deployment of an example, without what a test chooses itself: head and services.
std::pair<std::string, std::string> example(const std::string& name) {
  std::ifstream file(std::filesystem::path(QUOIN_EXAMPLES_DIR) / name);
  std::string head;
  std::string services;
  std::string* part = &head;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("version:") || line.starts_with("namespace:")) continue;
    if (line.starts_with("services:")) {
      part = &services;
    } else {
      *part += line + "\n";
    }
  }
  return {head, services};
}

TEST_F(Network, TheRobotOfTheExampleAccountsForEachScanThroughASwapAKillAndACut) {
  const auto [head, services] = example("robot_network.yaml");
  Robot robot(head, "", services);
  for (const char* host : {"lidar", "compute", "base"}) robot.up(host);
  ASSERT_TRUE(robot.has_published("corners", 10));
  ASSERT_TRUE(robot.has_published("beside_corners", 10)) << robot.logs();

  Process swap = robot.quoin("base", {"swap", "beside", "utls", "--deployment", "FILE", "--json"});
  EXPECT_EQ(swap.wait(20s), 0) << swap.errors();
  EXPECT_EQ(json::parse(swap.output(), nullptr, false)["method"], "utls");

  const auto strong = robot.latest("wctls@2").incarnation();
  ASSERT_EQ(kill(static_cast<pid_t>(robot.latest("wctls@2").pid()), SIGKILL), 0);
  ASSERT_TRUE(robot.has_published("corners", robot.latest("corners").published() + 10));
  ASSERT_TRUE(robot.has_restarted("wctls@2", strong));

  ASSERT_TRUE(robot.cut_for_five_seconds("compute", longest_cut * 10));
  ASSERT_TRUE(robot.has_published("corners", robot.latest("front").published() + 10));
  ASSERT_TRUE(robot.has_published("beside_corners", robot.latest("front").published() + 10));

  const json figures = robot.stop_all();
  std::cout << figures.dump() << '\n';  // what the README tells is from here
  EXPECT_EQ(figures["beside_corners"]["scans_lost"], 0) << robot.logs();
  for (const auto& [stage, count] : figures["corners"]["lost_by_stage"].items()) {
    EXPECT_EQ(stage, "wctls") << robot.logs();
  }
  EXPECT_EQ(figures["corners"]["lost_on_link"], 0) << robot.logs();
}

TEST_F(Network, ALosslessWriterGoesOnWhenTheLeaseOfAReaderThatWasCutHasEnded) {
  const Hosts hosts({"lidar", "base"});
  runtime::ParticipantConfig config{1, "test"};
  config.network.interfaces = {"eth0"};
  config.network.discovery = Discovery::multicast;
  config.network.lease = 2.0;
  runtime::Participant near(config);
  runtime::Writer<msg::ServiceStatus> writer(near, "scan", runtime::QosPreset::lossless);
  const auto far =
      hosts.on("lidar", [&] { return std::make_unique<runtime::Participant>(config); });
  runtime::Reader<msg::ServiceStatus> reader(*far, "scan", runtime::QosPreset::lossless);
  ASSERT_TRUE(writer.wait_for_readers(1, 20s));
  hosts.cut("lidar");
  const msg::ServiceStatus sample;
  EXPECT_TRUE(tests::eventually([&] { return !writer.write(sample); })) << "it has to wait first";
  EXPECT_TRUE(tests::eventually([&] { return writer.write(sample); }));
  // Fast DDS lets the writer go on before it counts the reader out.
  EXPECT_TRUE(tests::eventually([&] { return writer.matched() == 0; }));
}

TEST_F(Network, UpStartsTheShareOfOneHostAndSaysWhichThereAre) {
  const Hosts hosts({"base"});
  const TestDeployment deployment(chain, "network: {interfaces: eth7}\n");
  struct Wrong {
    std::vector<std::string> arguments;
    int exit_code;
    std::string text;
  };
  const std::vector<Wrong> all_wrong = {
      {{"up", "FILE"}, 2, "is for the hosts lidar, compute, base"},
      {{"up", "FILE", "--host", "bass"}, 2, "no host 'bass'; did you mean 'base'?"},
      {{"up", "FILE", "--host", "base"},
       1,
       "none of the interfaces eth7; it has lo (127.0.0.1), eth0 (10.77.0.1), aux0 (10.78.0.1)"},
      {{"discovery", "FILE"}, 1, "none of the interfaces eth7"},
      {{"status", "--interface", "eth0", "--discovery", "server"}, 2, "needs servers"},
      {{"status", "--peer", "10.77.0.300"}, 2, "must be an IPv4 address"}};
  for (const Wrong& wrong : all_wrong) {
    Process quoin = deployment.quoin(wrong.arguments);
    EXPECT_EQ(quoin.wait(20s), wrong.exit_code) << wrong.text;
    EXPECT_THAT(quoin.errors(), testing::HasSubstr(wrong.text));
  }
}

}  // namespace
}  // namespace quoin
