// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
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
