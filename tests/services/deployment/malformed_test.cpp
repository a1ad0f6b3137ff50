// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "deploy/kinds/kinds.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream stream(file);
  EXPECT_TRUE(stream) << file;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<fs::path> yaml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

class Malformed : public testing::TestWithParam<fs::path> {};

// Each file has beside it what must be said of it.
TEST_P(Malformed, IsReportedWithPlaceAndWayOut) {
  ::unsetenv("QUOIN_UNSET_FOR_TESTS");
  const std::string expected = content(fs::path(GetParam()).replace_extension(".expected"));
  try {
    (void)deploy::parse_deployment(content(GetParam()), GetParam().filename());
    FAIL() << "accepted";
  } catch (const DeploymentError& error) {
    EXPECT_EQ(std::string(error.what()) + "\n", expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Deploy, Malformed, testing::ValuesIn(yaml_files(QUOIN_MALFORMED_DIR)),
                         [](const auto& file) { return file.param.stem().string(); });

// Whatever is in the file: a deployment or a DeploymentError, nothing else.
void read_or_reject(const std::string& text) {
  try {
    (void)deploy::parse_deployment(text, "damaged.yaml");
  } catch (const DeploymentError& error) {
    ASSERT_FALSE(error.messages().empty());
    // yaml-cpp must not be led into using up the memory.
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("bad_alloc")));
  }
}

TEST(Damaged, FilesAreReadOrRejected) {
  std::mt19937 engine(7);
  const auto below = [&](std::size_t limit) { return engine() % limit; };
  const std::string marks = "{}[]:-,&*!|>'\"%@#?\n\t \x01\xff~$";
  for (const fs::path& file : yaml_files(QUOIN_EXAMPLES_DIR)) {
    const std::string text = content(file);
    for (int i = 0; i < 300; ++i) {
      std::string damaged = text;
      for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
        const std::size_t at = below(damaged.size());
        switch (below(4)) {
          case 0:
            damaged[at] = marks[below(marks.size())];
            break;
          case 1:
            damaged.insert(at, 1, marks[below(marks.size())]);
            break;
          case 2:
            damaged.erase(at, 1 + below(20));
            break;
          default:
            damaged.insert(at, damaged.substr(below(damaged.size()), 30));
            break;
        }
      }
      SCOPED_TRACE(damaged);
      read_or_reject(damaged);
    }
  }
}

TEST(Damaged, EndlessNestingIsRejected) {
  read_or_reject(std::string(100000, '['));
  read_or_reject(std::string(100000, '{'));
  std::string lists;
  for (int i = 0; i < 50000; ++i) lists += "- ";
  read_or_reject(lists);
}

TEST(Damaged, ManyErrorsAreCutShort) {
  std::string text = "version: 1\nservices:\n";
  for (int i = 0; i < 200; ++i) text += "  - {name: S, kind: k}\n";
  try {
    (void)deploy::parse_deployment(text, "many.yaml");
    FAIL() << "accepted";
  } catch (const DeploymentError& error) {
    EXPECT_EQ(error.messages().size(), 51U);
    EXPECT_THAT(error.messages().back(), testing::HasSubstr(" more"));
  }
}

}  // namespace
}  // namespace quoin
