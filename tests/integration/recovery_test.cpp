// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What public reports of other DDS applications say goes wrong: an observer that was there first
// and misses a recording, and processes that die while others do.
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/harness/leftovers.hpp"
#include "tests/integration/harness/test_tool.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using namespace std::string_literals;
using nlohmann::json;
using tests::Process;
using tests::TestDeployment;
using tests::TestRun;

/// Revolutions in a room, one a file.
void write_recording(const std::filesystem::path& folder, int revolutions) {
  std::filesystem::create_directory(folder);
  for (int i = 0; i < revolutions; ++i) {
    std::ofstream file(folder / ("scan_" + std::to_string(1000 + i) + ".csv"));
    for (int ray = 0; ray < 360; ++ray) {
      const double bearing = (ray + 0.5 - 180.0) * 0.017453292519943295;
      const double x = std::cos(bearing);
      const double y = std::sin(bearing);
      file << bearing << ',' << std::min((x >= 0 ? 2.5 : -1.5) / x, (y >= 0 ? 1.25 : -1.75) / y)
           << '\n';
    }
  }
}

TEST(Recovery, AnObserverThatWasThereFirstMissesNothingOfARecordingAtFullSpeed) {
  for (int run = 0; run < 5; ++run) {
    const TestDeployment deployment(R"(
  - {name: front, kind: replay, parameters: {path: scans, loop: false, rate_hz: 10, speed: 0}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: lines, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: lines}
)",
                                    "qos: lossless\n", "quoin_test_tool");
    write_recording(deployment.directory().path() / "scans", 50);
    Process echo = deployment.quoin({"echo", "FILE", "corners", "--json", "--count", "50"});
    std::this_thread::sleep_for(1500ms);
    Process up = deployment.quoin({"up", "FILE", "--json"});
    EXPECT_EQ(up.wait(60s), 0) << up.errors();
    EXPECT_EQ(echo.wait(5s), 0) << run << ": " << echo.errors();
    std::istringstream lines(echo.output());
    int number = 0;
    for (std::string line; std::getline(lines, line); ++number) {
      EXPECT_EQ(json::parse(line)["header"]["origins"][0]["sequence_number"], number);
    }
    EXPECT_EQ(number, 50) << run << ": " << echo.errors();
  }
}

pid_t parent_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string word; file >> word;) {
    pid_t parent = 0;
    if (word == "PPid:" && file >> parent) return parent;
  }
  return 0;
}

constexpr auto discovery = "discovery";
const std::vector<std::string> processes{discovery, "front", "walls", "lines", "corners"};

/// A chain whose participants find each other by a discovery server, with a lease of 3 s.
class Chain {
 public:
  Chain()
      : run_(
            "  - {name: front, kind: simulated, parameters: {rate_hz: 20, points: 360}}\n"
            "  - {name: walls, kind: segmentation, input: front}\n"
            "  - {name: lines, kind: line_fitting, input: walls, method: wctls}\n"
            "  - {name: corners, kind: corner_estimation, input: lines}\n",
            "qos: lossless\nnetwork: {interfaces: [127.0.0.1], discovery: server, lease: 3 s,\n"
            "  servers: [\"127.0.0.1:" +
                std::to_string(30'000 + getpid() % 20'000) + "\"]}\n") {
    run_.up();
  }

  [[nodiscard]] TestRun& run() { return run_; }

  [[nodiscard]] pid_t process(const std::string& name) {
    if (name != discovery) return run_.pid_of(name);
    for (const pid_t process : tests::processes_naming("quoin_test_tool\0discovery\0"s)) {
      if (parent_of(process) == run_.pid()) return process;
    }
    return 0;
  }

 private:
  TestRun run_;
};

class KilledTogether : public testing::TestWithParam<std::string> {};

// Of two that die a chain recovers when those that live have forgotten them: a few leases.
TEST_P(KilledTogether, TheChainGoesOnAndEachScanIsAccountedFor) {
  constexpr auto longest = 20s;
  Chain chain;
  TestRun& run = chain.run();
  ASSERT_TRUE(run.has_published("corners", 20)) << run.log();
  const std::string& first = GetParam();
  for (const std::string& second : processes) {
    if (second == first) continue;
    SCOPED_TRACE(first + " and " + second);
    const pid_t one = chain.process(first);
    const pid_t other = chain.process(second);
    ASSERT_GT(one, 0);
    ASSERT_GT(other, 0);
    ASSERT_EQ(kill(one, SIGKILL), 0);
    std::this_thread::sleep_for(first == discovery ? 1000ms : 500ms);
    ASSERT_EQ(kill(other, SIGKILL), 0);
    const auto killed = std::chrono::steady_clock::now();
    ASSERT_TRUE(tests::eventually([&] {
      run.poll();
      return chain.process(first) != one && chain.process(second) != other &&
             chain.process(first) > 0 && chain.process(second) > 0;
    })) << run.log();
    ASSERT_TRUE(run.goes_on("corners", 40, longest)) << run.log();
    std::cerr << first << " and " << second << ": again after "
              << std::chrono::duration<double>(std::chrono::steady_clock::now() - killed).count()
              << " s\n";
  }
  (void)run.end();
}

INSTANTIATE_TEST_SUITE_P(Recovery, KilledTogether, testing::ValuesIn(processes),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quoin
