// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "services/deployment/deployment.hpp"
#include "deploy/kinds/kinds.hpp"

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

TEST_P(Examples, AreValidAndEndInCorners) {
  const Deployment deployment = deploy::load_deployment(GetParam());
  ASSERT_FALSE(deployment.services.empty());
  EXPECT_EQ(deploy::find_kind(deployment.services.front().kind)->input, MessageType::none);
  EXPECT_EQ(deploy::find_kind(deployment.services.back().kind)->output, MessageType::corners);
  for (const ServiceConfig& service : deployment.services) {
    const MessageType output = deploy::find_kind(service.kind)->output;
    if (output != MessageType::none && deployment.readers_of(service.name).empty()) {
      EXPECT_EQ(service.kind, "corner_estimation") << service.name << " is read by nobody";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Deploy, Examples, testing::ValuesIn(examples()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace quoin
