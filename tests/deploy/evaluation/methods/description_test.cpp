// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/description.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "deploy/evaluation/methods/parameter_text.hpp"
#include "tests/deploy/evaluation/methods/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using ::testing::HasSubstr;

TEST(ParameterText, TellsTypeAndRange) {
  ParameterInfo info = parameter("depth", "2");
  EXPECT_EQ(range_text(info), "real 1..9");
  info.maximum = no_limit;
  EXPECT_EQ(range_text(info), "real 1..");
  info.minimum = -no_limit;
  EXPECT_EQ(range_text(info), "real");
  info.type = ParameterType::choice;
  info.choices = {"soft", "hard"};
  EXPECT_EQ(range_text(info), "soft or hard");
  EXPECT_EQ(default_text(info), "2");
  info.default_value.clear();
  EXPECT_EQ(default_text(info), "''");
}

TEST(Description, JsonHasAllThatIsKnown) {
  const auto json = description_json(kind_of_two_methods());
  EXPECT_EQ(json["kind"], "cutting");
  EXPECT_EQ(json["input"], "scan");
  EXPECT_EQ(json["output"], "segments");
  ASSERT_EQ(json["methods"].size(), 2U);
  const auto& laser = json["methods"][1];
  EXPECT_EQ(laser["name"], "laser");
  EXPECT_EQ(laser["description"], "cuts fast");
  EXPECT_EQ(laser["source"], "Jones 2000");
  EXPECT_EQ(laser["choose"], "For steel.");
  ASSERT_EQ(laser["parameters"].size(), 3U);
  EXPECT_EQ(laser["parameters"][1]["name"], "depth");
  EXPECT_EQ(laser["parameters"][1]["unit"], "m");
  EXPECT_EQ(laser["parameters"][1]["default"], "2");
  EXPECT_EQ(laser["parameters"][1]["minimum"], 1.0);
}

TEST(Description, TextHasAllThatIsKnown) {
  const std::string text = description_text(kind_of_two_methods());
  EXPECT_THAT(text, HasSubstr("cutting: cuts scans\n  reads scan, publishes segments\n"));
  EXPECT_THAT(text, HasSubstr("  saw (default): cuts slowly\n    source: Smith 1900\n"
                              "    choose: For wood.\n      depth = 2 m  (real 1..9)\n"
                              "          what it does\n"));
  EXPECT_THAT(text, HasSubstr("  laser: cuts fast\n"));
}

}  // namespace
}  // namespace quoin::deploy
