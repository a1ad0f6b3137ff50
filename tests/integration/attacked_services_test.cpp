// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Running services beside a hostile neighbour, and with damaged files, without `quoin`: small
// enough to be built with AddressSanitizer and UndefinedBehaviorSanitizer, whose reports end a
// process with another code.
#include <csignal>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/hostile_neighbour.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::string content_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Text as a file that is left half written, or with a few bytes of its own changed.
std::string damaged(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  if (below(3) == 0) return text.substr(0, below(text.size()));
  for (std::size_t changes = 1 + below(8); changes > 0; --changes) {
    text[below(text.size())] = static_cast<char>(below(256));
  }
  return text;
}

TEST(AttackedServices, GoOnAndEndAsIfNobodyHadAttackedThem) {
  const tests::TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 10, points: 180}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: lines, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: lines}
)");
  std::map<std::string, tests::Process> services;
  for (const char* name : {"corners", "lines", "walls", "front"}) {
    services.emplace(name, deployment.start(name));
  }
  runtime::Participant participant(deployment.participant("test"));
  tests::StatusRecorder status(participant, deployment);
  const auto active = [](const msg::ServiceStatus& s) { return s.state() == msg::STATE_ACTIVE; };
  for (const auto& [name, process] : services) {
    ASSERT_TRUE(status.wait_for(name, active)) << name << process.errors();
  }
  constexpr int attacks = 12;
  tests::HostileNeighbour neighbour(deployment, "front", "walls", "lines", 20261128);
  ASSERT_TRUE(tests::eventually([&] {
    neighbour.listen();
    return neighbour.informed();
  }));
  for (int attack = 0; attack < attacks; ++attack) {
    neighbour.listen();
    neighbour.attack();
    std::this_thread::sleep_for(50ms);  // as often as it lets them work
  }
  EXPECT_GE(neighbour.counts().at("garbage"), attacks);
  for (const char* name : {"walls", "lines", "corners"}) {
    EXPECT_TRUE(status.wait_for(name, [&](const msg::ServiceStatus& heartbeat) {
      return active(heartbeat) && !heartbeat.inputs()[0].refused().empty();
    })) << name;
  }
  for (auto& [name, process] : services) {
    process.signal(SIGTERM);
    EXPECT_EQ(process.wait(20s), 0) << name << process.errors();
    EXPECT_THAT(process.errors(), Not(HasSubstr("runtime error"))) << name;
  }
}

TEST(AttackedServices, AReplayOfADamagedFileGivesWhatIsGoodOfItOrSaysWhatIsWrong) {
  const std::string corpus = QUOIN_CORPUS_DIR;
  std::string carmen;
  std::string table = "angle_deg,range_m\n";
  for (int i = 0; i < 20; ++i) {
    carmen += "FLASER 4 1.0 2.0 2.5 1.5 0 0 0 0 0 0 " + std::to_string(0.1 * i) + " host " +
              std::to_string(0.1 * i) + "\n";
    table += std::to_string(9 * i) + ",2.5\n";
  }
  const std::map<std::string, std::string> files{{"log", carmen},
                                                 {"csv", table},
                                                 {"bag", content_of(corpus + "/bag/lz4")},
                                                 {"db3", content_of(corpus + "/bag/sqlite")},
                                                 {"mcap", content_of(corpus + "/mcap/chunk")}};
  constexpr int copies = 4;  // of each file; the first as it is
  std::string services;
  for (const auto& [ending, content] : files) {
    ASSERT_FALSE(content.empty()) << ending;
    for (int copy = 0; copy < copies; ++copy) {
      const std::string name = ending + std::to_string(copy);
      services += "  - {name: " + name + ", kind: replay, parameters: {path: " + name + "." +
                  ending + ", scans: 2, rate_hz: 100}}\n";
    }
  }
  const tests::TestDeployment deployment("\n" + services);
  std::mt19937 random(20261129);
  for (const auto& [ending, content] : files) {
    for (int copy = 0; copy < copies; ++copy) {
      deployment.directory().write(ending + std::to_string(copy) + "." + ending,
                                   copy == 0 ? content : damaged(content, random));
    }
  }
  std::vector<int> codes;
  for (const auto& [ending, content] : files) {
    std::map<std::string, tests::Process> replays;
    for (int copy = 0; copy < copies; ++copy) {
      const std::string name = ending + std::to_string(copy);
      replays.emplace(name, deployment.start(name));
    }
    for (auto& [name, replay] : replays) {
      const auto code = replay.wait(30s);
      ASSERT_TRUE(code.has_value()) << name << replay.errors();
      codes.push_back(*code);
      EXPECT_THAT(*code, AnyOf(0, 2, 3)) << name << replay.errors();
      EXPECT_THAT(replay.errors(), Not(AnyOf(HasSubstr("runtime error"), HasSubstr("Sanitizer"))))
          << name;
    }
  }
  EXPECT_THAT(codes, Contains(0));
  EXPECT_THAT(codes, Contains(AnyOf(2, 3)));
}

}  // namespace
}  // namespace quoin
