// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/harness/process.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  std::optional<int> exit_code;
  std::string output, errors;
};

class CommandLine : public testing::Test {
 protected:
  Outcome quoin(const std::vector<std::string>& arguments) {
    tests::Process process("quoin", arguments, folder_);
    const auto exit_code = process.wait(20s);
    return {exit_code, process.output(), process.errors()};
  }
  const tests::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(CommandLine, NamesTheCommandThatWasMeant) {
  const Outcome outcome = quoin({"stauts"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("'stauts'"));
  EXPECT_THAT(outcome.errors, HasSubstr("did you mean 'status'?"));
}

TEST_F(CommandLine, HelpIsACommandAndAnOption) {
  EXPECT_EQ(quoin({"help"}).exit_code, 0);
  const Outcome asked = quoin({"help", "draw"});
  EXPECT_EQ(asked.exit_code, 0);
  EXPECT_EQ(asked.output, quoin({"draw", "--help"}).output);
}

TEST_F(CommandLine, TheVersionIsACommandAndAnOption) {
  const Outcome asked = quoin({"--version"});
  EXPECT_EQ(asked.exit_code, 0);
  EXPECT_THAT(asked.output, StartsWith("quoin "));
  EXPECT_EQ(asked.output, quoin({"version"}).output);
}

TEST_F(CommandLine, ABundleSaysWhatItHolds) {
  std::ofstream(folder_ / "robot.yaml") << "version: 1\nservices: []\n";
  const std::filesystem::path bundle = folder_ / "bundle.tar.gz";
  const Outcome outcome = quoin({"bundle", folder_ / "robot.yaml", "-o", bundle});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* file : {"version.json", "deployment.yaml", "check.txt", "status.json"}) {
    EXPECT_THAT(outcome.output, HasSubstr(file));
  }
  EXPECT_GT(std::filesystem::file_size(bundle), 0U);
  EXPECT_EQ(std::filesystem::status(bundle).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(CommandLine, WritesManualPagesOfCommandsAndPrograms) {
  const Outcome outcome = quoin({"man", "-o", folder_ / "man"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* page : {"quoin.1", "quoin-up.1", "quoin-segmentation.1", "quoin-process.1"}) {
    std::ifstream stream(folder_ / "man" / page);
    std::string line;
    std::getline(stream, line);
    EXPECT_THAT(line, StartsWith(".TH QUOIN")) << page;
  }
}

TEST_F(CommandLine, TimesMayHaveAUnit) {
  // The file is missing, which is found after the command line was read.
  const auto code = [&](const char* time) {
    return quoin({"up", folder_ / "none.yaml", "--duration", time}).errors;
  };
  for (const char* time : {"5m", "5 min", "500ms", "0.5", "1h"}) {
    EXPECT_THAT(code(time), HasSubstr("none.yaml")) << time;
  }
  EXPECT_THAT(code("5 kg"), HasSubstr("is not a time"));
  EXPECT_THAT(code("0 s"), HasSubstr("not more than 0"));
}

}  // namespace
}  // namespace quoin
