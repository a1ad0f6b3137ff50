// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/kinds/kinds.hpp"

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "services/deployment/known_outputs.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin {
namespace {

using testing::ElementsAre;

std::vector<std::string> names_of(const std::vector<MethodInfo>& methods) {
  std::vector<std::string> names;
  for (const MethodInfo& method : methods) names.push_back(method.name);
  return names;
}

TEST(Kinds, AreListedSourcesFirst) {
  std::vector<std::string> names;
  for (const KindInfo* kind : deploy::kinds().kinds) names.push_back(kind->name);
  EXPECT_THAT(names, ElementsAre("simulated", "replay", "rplidar", "rplidar_emulator", "ros2_scan",
                                 "ros2_odometry", "deskewing", "segmentation", "line_fitting",
                                 "corner_estimation", "circle_fitting", "mapping", "localization",
                                 "viewer", "recorder", "ros2_output", "external"));
}

TEST(Kinds, FormAChainFromScansToCorners) {
  std::string type = deploy::find_kind("simulated")->outputs.front().type;
  for (const char* name : {"segmentation", "line_fitting", "corner_estimation"}) {
    const KindInfo* kind = deploy::find_kind(name);
    ASSERT_EQ(kind->inputs.size(), 1U) << name;
    EXPECT_EQ(kind->inputs.front().type, type) << name;
    ASSERT_EQ(kind->outputs.size(), 1U) << name;
    type = kind->outputs.front().type;
  }
  EXPECT_EQ(type, "corners");
}

TEST(Kinds, MakeCirclesOfWhatLinesAreMadeOf) {
  const KindInfo* kind = deploy::find_kind("circle_fitting");
  ASSERT_EQ(kind->inputs.size(), 1U);
  EXPECT_EQ(kind->inputs.front().type, deploy::find_kind("line_fitting")->inputs.front().type);
  ASSERT_EQ(kind->outputs.size(), 1U);
  EXPECT_EQ(kind->outputs.front().type, "circles");
}

// What the wiring of a deployment relies on.
TEST(Kinds, HavePortsThatFit) {
  for (const KindInfo* kind : deploy::kinds().kinds) {
    std::size_t each = 0;
    for (const InputPort& port : kind->inputs) {
      EXPECT_NE(topics::find_topic_type(port.type), nullptr) << kind->name << ' ' << port.name;
      if (port.join == Join::each) ++each;
    }
    bool per_input = false;
    for (const OutputPort& port : kind->outputs) {
      EXPECT_NE(topics::find_topic_type(port.type), nullptr) << kind->name << ' ' << port.type;
      EXPECT_EQ(kind->output(port.type), &port) << "two outputs of one type";
      per_input = per_input || port.rate == Rate::per_input;
    }
    // A result per message needs one port that the messages come by.
    if (kind->reads() && per_input) {
      EXPECT_EQ(each, 1U) << kind->name;
    }
    if (kind->is_source() && kind->output("scan") != nullptr) {
      EXPECT_EQ(kind->outputs.front().type, "scan") << kind->name;
      EXPECT_EQ(kind->outputs.front().rate, Rate::per_input) << kind->name;
    }
    EXPECT_EQ(kind->program.empty(), kind == &external_kind()) << kind->name;
  }
}

TEST(Kinds, KnowTheMethods) {
  EXPECT_THAT(names_of(deploy::find_kind("segmentation")->methods), testing::Contains("iepf"));
  EXPECT_THAT(names_of(deploy::find_kind("line_fitting")->methods),
              testing::IsSupersetOf({"utls", "wtls", "wctls"}));
  EXPECT_THAT(names_of(deploy::find_kind("corner_estimation")->methods),
              testing::Contains("adjacent"));
  EXPECT_THAT(names_of(deploy::find_kind("circle_fitting")->methods),
              testing::IsSupersetOf({"maximum_likelihood", "taubin"}));
  EXPECT_THAT(deploy::find_kind("simulated")->methods, testing::IsEmpty());
}

TEST(Kinds, UnknownNamesAreNotFound) {
  EXPECT_EQ(deploy::find_kind("lidar"), nullptr);
  EXPECT_EQ(deploy::find_kind(""), nullptr);
}

TEST(Kinds, ObserversKnowTheirOutputs) {
  for (const KindInfo* kind : deploy::kinds().kinds) {
    if (kind == &external_kind()) continue;
    const KindInfo* known = known_outputs(kind->name);
    ASSERT_NE(known, nullptr) << kind->name;
    ASSERT_EQ(known->outputs.size(), kind->outputs.size()) << kind->name;
    for (std::size_t i = 0; i < kind->outputs.size(); ++i) {
      const OutputPort& port = kind->outputs[i];
      EXPECT_EQ(known->outputs[i].type, port.type) << kind->name;
      EXPECT_EQ(known->outputs[i].rate, port.rate) << kind->name;
      ASSERT_EQ(known->outputs[i].parameter, port.parameter) << kind->name;
      for (const char* value : {"true", "false", "scan", "lines, scan"}) {
        const ParameterSettings settings{{port.parameter, value}};
        EXPECT_EQ(known->gives(port, settings), kind->gives(port, settings))
            << kind->name << ' ' << port.type << ' ' << value;
      }
      EXPECT_EQ(known->gives(port, {}), kind->gives(port, {})) << kind->name << ' ' << port.type;
    }
  }
  EXPECT_EQ(known_outputs("test_join"), nullptr);
}

TEST(Kinds, AReplayGivesTheTypesThatItIsAskedFor) {
  const KindInfo& replay = *deploy::find_kind("replay");
  const auto given = [&](const ParameterSettings& settings) {
    std::vector<std::string> types;
    for (const OutputPort& port : replay.outputs) {
      if (replay.gives(port, settings)) types.push_back(port.type);
    }
    return types;
  };
  EXPECT_THAT(given({}), ElementsAre("scan"));
  EXPECT_THAT(given({{"odometry", "true"}}), ElementsAre("scan", "odometry"));
  EXPECT_THAT(given({{"messages", "lines,segments "}}), ElementsAre("segments", "lines"));
  EXPECT_THAT(given({{"messages", "line"}}), ElementsAre());
}

TEST(Kinds, ParametersComeFromTheMethodOrTheKind) {
  const KindInfo& segmentation = *deploy::find_kind("segmentation");
  EXPECT_EQ(&parameters_of(segmentation, "iepf"), &segmentation.methods.front().parameters);
  EXPECT_THROW((void)parameters_of(segmentation, "none"), std::out_of_range);
  const KindInfo& simulated = *deploy::find_kind("simulated");
  EXPECT_EQ(&parameters_of(simulated, ""), &simulated.parameters);
  EXPECT_FALSE(simulated.parameters.empty());
}

TEST(Kinds, EveryParameterIsDescribedAndItsDefaultIsValid) {
  for (const KindInfo* each : deploy::kinds().kinds) {
    const KindInfo& kind = *each;
    EXPECT_FALSE(kind.description.empty());
    std::vector<std::vector<ParameterInfo>> lists{kind.parameters};
    for (const MethodInfo& method : kind.methods) {
      EXPECT_FALSE(method.description.empty()) << method.name;
      EXPECT_FALSE(method.source.empty()) << method.name;
      EXPECT_FALSE(method.choose.empty()) << method.name;
      lists.push_back(method.parameters);
    }
    for (const auto& list : lists) {
      std::set<std::string> names;
      for (const ParameterInfo& info : list) {
        EXPECT_TRUE(names.insert(info.name).second) << info.name << " twice in " << kind.name;
        EXPECT_FALSE(info.description.empty()) << info.name;
        EXPECT_NO_THROW(check_parameter(info, info.default_value)) << info.name;
      }
    }
  }
}

}  // namespace
}  // namespace quoin
