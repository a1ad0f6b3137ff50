// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>

#include "tests/integration/harness/deployment.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using tests::Process;
using tests::TemporaryFolder;
using tests::TestDeployment;

std::string read(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Output and errors of a shell command, and its exit code behind them.
std::string run_shell(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::string text;
  for (int character = std::fgetc(pipe); character != EOF; character = std::fgetc(pipe)) {
    text += static_cast<char>(character);
  }
  return text + "exit " + std::to_string(::pclose(pipe));
}

TEST(Export, SystemdAcceptsTheUnitsOfTheExamples) {
  if (::access("/usr/bin/systemd-analyze", X_OK) != 0) {
    GTEST_SKIP() << "systemd-analyze is not here (Debian package systemd): units are not verified";
  }
  const TemporaryFolder directory;
  for (const char* example : {"minimal", "rplidar_s1", "rplidar_emulated"}) {
    SCOPED_TRACE(example);
    const auto folder = directory.path() / example;
    Process quoin("quoin",
                  {"export", "systemd", std::string(QUOIN_EXAMPLES_DIR) + "/" + example + ".yaml",
                   "-o", folder.string()},
                  directory.path());
    ASSERT_EQ(quoin.wait(60s), 0) << quoin.errors();
    EXPECT_EQ(run_shell("cd " + folder.string() + " && systemd-analyze verify ./*"), "exit 0");
  }
  // systemd finds the program only if it reads the path as it was meant.
  const auto odd = directory.path() / "100% $HOME \xc3\xa4";
  std::filesystem::create_directory(odd);
  for (const char* program :
       {"quoin-simulated", "quoin-segmentation", "quoin-line-fitting", "quoin-corner-estimation"}) {
    std::filesystem::create_symlink(std::string(QUOIN_BIN_DIR) + "/" + program, odd / program);
  }
  std::filesystem::copy_file(std::string(QUOIN_EXAMPLES_DIR) + "/minimal.yaml",
                             odd / "a 'b' \"c\\.yaml");
  Process quoin("quoin",
                {"export", "systemd", (odd / "a 'b' \"c\\.yaml").string(), "--programs",
                 odd.string(), "-o", (directory.path() / "odd").string()},
                directory.path());
  ASSERT_EQ(quoin.wait(60s), 0) << quoin.errors();
  EXPECT_EQ(run_shell("cd " + directory.path().string() + "/odd && systemd-analyze verify ./*"),
            "exit 0");
  // [0, 10]; a unit without any of it has 9.6.
  const std::string report =
      run_shell("systemd-analyze security --offline=true --threshold=20 " +
                (directory.path() / "minimal/quoin-quoin-lines.service").string());
  EXPECT_THAT(report, AllOf(HasSubstr("Overall exposure level"), HasSubstr("exit 0")));
}

TEST(Export, AUnitsCommandLineRunsInAShell) {
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 100, scans: 3}}
)");
  const auto folder = deployment.directory().path() / "units";
  Process quoin = deployment.quoin({"export", "systemd", "FILE", "-o", folder.string()});
  ASSERT_EQ(quoin.wait(60s), 0) << quoin.errors();
  EXPECT_THAT(quoin.errors(), HasSubstr("below /tmp, which the units do not see"));
  const std::string name = "quoin-" + deployment.deployment().name_space + "-front.service";
  const std::string unit = read(folder / name);
  const std::string key = "\nExecStart=";
  const std::size_t begin = unit.find(key) + key.size();
  const std::string command = unit.substr(begin, unit.find('\n', begin) - begin);
  EXPECT_THAT(command, testing::EndsWith(" --service front"));
  EXPECT_EQ(run_shell(command), "exit 0");
}

TEST(Export, LeavesTheFilesOfOthersAlone) {
  const TestDeployment deployment("  - {name: front, kind: simulated}\n");
  const auto file = deployment.directory().write("compose.yaml", "services: {}\n");
  const std::vector<std::string> words{"export", "compose", "FILE", "-o", file.string()};
  Process refused = deployment.quoin(words);
  EXPECT_EQ(refused.wait(60s), 1);
  EXPECT_THAT(refused.errors(), HasSubstr("was not written by quoin export; --force replaces it"));
  EXPECT_EQ(read(file), "services: {}\n");
  std::vector<std::string> forced_words = words;
  forced_words.emplace_back("--force");
  Process forced = deployment.quoin(forced_words);
  EXPECT_EQ(forced.wait(60s), 0) << forced.errors();
  Process again = deployment.quoin(words);
  EXPECT_EQ(again.wait(60s), 0) << again.errors();
  EXPECT_THAT(read(file), AllOf(HasSubstr("network_mode: host"), HasSubstr("quoin-simulated")));
}

}  // namespace
}  // namespace quoin
