// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "deploy/kinds/kinds.hpp"
#include "services/deployment/deployment.hpp"
#include "services/deployment/graph.hpp"

namespace quoin {
namespace {

std::vector<std::filesystem::path> examples() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(QUOIN_EXAMPLES_DIR)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

class Examples : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(Examples, AreValidAndEndInResults) {
  const Deployment deployment = deploy::load_deployment(GetParam());
  ASSERT_FALSE(deployment.services.empty());
  EXPECT_TRUE(deployment.services.front().inputs.empty());
  // Observers stand behind all others.
  const auto last = std::find_if(deployment.services.rbegin(), deployment.services.rend(),
                                 [](const auto& each) { return !each.info->observer; });
  EXPECT_TRUE(last->output("corners") != nullptr || last->output("pose") != nullptr);
  const std::set<std::string> results{"corners", "circles", "pose", "line_map"};
  for (const Connection& end : Graph(deployment).ends()) {
    EXPECT_TRUE(results.contains(end.type)) << end.writer->name << " is read by nobody";
  }
}

INSTANTIATE_TEST_SUITE_P(Deploy, Examples, testing::ValuesIn(examples()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace quoin
