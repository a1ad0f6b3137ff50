// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// A deployment beside a neighbour that speaks for its services, on a network without security.
#include <array>
#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/node/clock.hpp"
#include "services/topics/header.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/hostile_neighbour.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using tests::eventually;
using tests::HostileNeighbour;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

const char* const chain = R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 20}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: lines, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: lines, method: adjacent}
)";

// Waits for the result of a scan that was published from now on.
bool next_corners_arrive(tests::CornerRecorder& corners) {
  const std::int64_t now = runtime::now_ns();
  return eventually([&] {
    corners.poll();
    return corners.messages().back().header().trace()[0].published() > now;
  });
}

TEST(HostileNeighbour, ChangesNothingOfWhatServicesDo) {
  // A burst takes the place of scans that wait to be read, when a busy host lets them wait. What
  // is tested is that nothing else of it costs one: queues hold two rounds of attacks, and each
  // round is behind the services before the next begins.
  const TestDeployment deployment(chain, "qos: feature\n");
  Process up = deployment.quoin({"up", "FILE", "--json"});
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  tests::CornerRecorder corners(participant, deployment, "corners");
  ASSERT_TRUE(corners.wait_for(20));
  {
    HostileNeighbour neighbour(deployment, "front", "walls", "lines", 1);
    ASSERT_TRUE(eventually([&] {
      neighbour.listen();
      return neighbour.informed();
    }));
    for (int i = 0; i < 30; ++i) {
      neighbour.listen();
      neighbour.attack();
      ASSERT_TRUE(next_corners_arrive(corners)) << "nothing comes out after attack " << i;
    }
    EXPECT_GT(neighbour.counts().at("jump beyond all"), 20);
    EXPECT_GT(neighbour.counts().at("overlap"), 20);
  }
  for (const char* service : {"walls", "lines", "corners"}) {
    EXPECT_TRUE(status.wait_for(service, [](const msg::ServiceStatus& heartbeat) {
      return heartbeat.state() == msg::STATE_ACTIVE && !heartbeat.inputs()[0].refused().empty();
    })) << service;
  }
  for (const msg::Corners& message : corners.messages()) {
    for (const msg::Corner& corner : message.corners()) {
      ASSERT_GT(corner.covariance_xx(), 0.0);
      ASSERT_GT(corner.covariance_yy(), 0.0);
      ASSERT_GT(corner.ellipse_area(), 0.0);
    }
  }
  EXPECT_EQ(corners.accounting().lost(), 0U);

  up.signal(SIGINT);
  EXPECT_EQ(up.wait(20s), 0);
  const json summary = json::parse(up.output(), nullptr, false);
  ASSERT_TRUE(summary.is_object());
  const json& end = summary.at("ends").at("corners");
  const auto published = summary.at("services").at("front").at("numbered").at("scan");
  EXPECT_EQ(
      end.at("scans_delivered").get<std::uint64_t>() + end.at("scans_lost").get<std::uint64_t>(),
      published.get<std::uint64_t>());
  EXPECT_EQ(end.at("scans_lost"), 0);
  EXPECT_LT(up.errors().size(), 100'000U);
  EXPECT_THAT(up.errors(), Not(HasSubstr("\x1b")));
  EXPECT_THAT(up.errors(), Not(HasSubstr("\nerror: a forged line")));
}

TEST(HostileNeighbour, IsNamedByStatusAndDoctorWhenItWritesToATopicOfAService) {
  const TestDeployment deployment(chain);
  Process up = deployment.quoin({"up", "FILE", "--json"});
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  const auto active = [](const msg::ServiceStatus& s) { return s.state() == msg::STATE_ACTIVE; };
  ASSERT_TRUE(status.wait_for("corners", active));
  ASSERT_TRUE(status.wait_for("front", active));
  // More services than there are places for: those of the deployment are heard all the same.
  runtime::Writer<msg::ServiceStatus> crowd(
      participant, status_topic(deployment.deployment().name_space), runtime::QosPreset::state);
  msg::ServiceStatus ghost = status.latest("front");
  for (std::uint64_t number = 1; number <= 6000; ++number) {
    ghost.service("ghost_" + std::to_string(number));
    ghost.incarnation(number);
    ASSERT_TRUE(crowd.write(ghost));
  }
  Process calm = deployment.quoin({"status", "FILE"});
  EXPECT_EQ(calm.wait(20s), 0);
  EXPECT_THAT(calm.output(), Not(HasSubstr("writers")));
  const runtime::Writer<msg::Scan> second(participant, deployment.topic("front"),
                                          runtime::QosPreset::sensor);
  ASSERT_TRUE(status.wait_for("walls", [](const msg::ServiceStatus& heartbeat) {
    return heartbeat.inputs()[0].writers() == 2;
  }));
  const std::string named = "topic " + deployment.topic("front") + " has 2 writers";
  Process shown = deployment.quoin({"status", "FILE"});
  EXPECT_EQ(shown.wait(20s), 0);
  EXPECT_THAT(shown.output(), HasSubstr(named));
  Process doctor = deployment.quoin({"doctor", "FILE"});
  EXPECT_EQ(doctor.wait(20s), 1);
  EXPECT_THAT(doctor.output(), HasSubstr(named));
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(20s), 0);
}

TEST(HostileNeighbour, AServiceThatCanUseNothingIsNotActive) {
  const TestDeployment deployment(chain);
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  const tests::CornerRecorder corners(participant, deployment, "corners");
  runtime::Writer<msg::Lines> writer(participant, deployment.topic("lines"),
                                     runtime::QosPreset::feature);
  const Process service = deployment.start("corners", 1);
  ASSERT_TRUE(writer.wait_for_readers(1, 20s));
  msg::Lines lines;
  topics::set_origin(lines.header(), "front", 1, 0);
  lines.lines().resize(1);  // with a covariance of zero
  EXPECT_TRUE(status.wait_for("corners", [&](const msg::ServiceStatus& heartbeat) {
    writer.write(lines);
    return heartbeat.state() == msg::STATE_FAILED;
  }));
  EXPECT_THAT(status.latest("corners").detail(), HasSubstr("nothing that comes can be used"));
  lines.lines().clear();
  EXPECT_TRUE(status.wait_for("corners", [&](const msg::ServiceStatus& heartbeat) {
    writer.write(lines);
    return heartbeat.state() == msg::STATE_ACTIVE;
  }));
}

/// A program of the tool whose standard output is `descriptor`, which is closed here.
pid_t start(const std::vector<std::string>& arguments, int descriptor) {
  std::vector<std::string> words{QUOIN_BIN_DIR "/quoin"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t process = ::fork();
  if (process == 0) {
    ::dup2(descriptor, STDOUT_FILENO);
    const int nothing = ::open("/dev/null", O_WRONLY);
    ::dup2(nothing, STDERR_FILENO);
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }
  ::close(descriptor);
  return process;
}

/// Exit code, 128 + signal when killed; -1 when it still runs after 20 s, and is killed then.
int end_of(pid_t process) {
  int status = 0;
  if (!eventually([&] { return ::waitpid(process, &status, WNOHANG) == process; })) {
    ::kill(process, SIGKILL);
    ::waitpid(process, &status, 0);
    return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(FullDisk, ACommandThatCannotWriteFails) {
  const TestDeployment deployment(chain);
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"version"},
                                                    {"check", deployment.file().string()},
                                                    {"check", deployment.file().string(), "--json"},
                                                    {"methods"},
                                                    {"--help"},
                                                    {"doctor"}}) {
    EXPECT_EQ(end_of(start(arguments, ::open("/dev/full", O_WRONLY))), 1) << arguments[0];
    if (arguments[0] == "doctor") continue;  // whatever this host is like
    EXPECT_EQ(end_of(start(arguments, ::open("/dev/null", O_WRONLY))), 0) << arguments[0];
  }
}

TEST(FullPipe, EchoEndsAtASignal) {
  const TestDeployment deployment(
      "\n  - {name: front, kind: simulated, parameters: {rate_hz: 50, points: 2000}}\n");
  Process up = deployment.quoin({"up", "FILE", "--quiet"});
  for (const int signal : {SIGTERM, SIGINT}) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
    ::fcntl(pipe[1], F_SETPIPE_SZ, 4096);
    const pid_t echo = start({"echo", deployment.file().string(), "front", "--json"}, pipe[1]);
    // It has printed something, and nobody reads the rest.
    std::array<char, 100> some{};
    EXPECT_GT(::read(pipe[0], some.data(), some.size()), 0);
    std::this_thread::sleep_for(300ms);
    ::kill(echo, signal);
    EXPECT_EQ(end_of(echo), 128 + signal);
    ::close(pipe[0]);
  }
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(20s), 0);
}

}  // namespace
}  // namespace quoin
