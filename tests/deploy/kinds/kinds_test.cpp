// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/kinds/kinds.hpp"

#include <set>
#include <stdexcept>

#include <gmock/gmock.h>

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
  for (const KindInfo& kind : deploy::kinds()) names.push_back(kind.name);
  EXPECT_THAT(names, ElementsAre("simulated", "replay", "rplidar", "rplidar_emulator",
                                 "segmentation", "line_fitting", "corner_estimation"));
}

TEST(Kinds, FormAChainFromScansToCorners) {
  const auto check = [](const char* name, MessageType input, MessageType output,
                        const char* program, const char* qos) {
    const KindInfo* kind = deploy::find_kind(name);
    ASSERT_NE(kind, nullptr) << name;
    EXPECT_EQ(kind->input, input) << name;
    EXPECT_EQ(kind->output, output) << name;
    EXPECT_EQ(kind->program, program);
    EXPECT_EQ(kind->qos, qos) << name;
  };
  check("simulated", MessageType::none, MessageType::scan, "quoin-simulated", "sensor");
  check("replay", MessageType::none, MessageType::scan, "quoin-replay", "sensor");
  check("rplidar", MessageType::none, MessageType::scan, "quoin-rplidar", "sensor");
  check("rplidar_emulator", MessageType::none, MessageType::none, "quoin-rplidar-emulator-service",
        "sensor");
  check("segmentation", MessageType::scan, MessageType::segments, "quoin-segmentation", "feature");
  check("line_fitting", MessageType::segments, MessageType::lines, "quoin-line-fitting", "feature");
  check("corner_estimation", MessageType::lines, MessageType::corners, "quoin-corner-estimation",
        "feature");
}

TEST(Kinds, KnowTheMethods) {
  EXPECT_THAT(names_of(deploy::find_kind("segmentation")->methods), testing::Contains("iepf"));
  EXPECT_THAT(names_of(deploy::find_kind("line_fitting")->methods),
              testing::IsSupersetOf({"utls", "wtls", "wctls"}));
  EXPECT_THAT(names_of(deploy::find_kind("corner_estimation")->methods), testing::Contains("adjacent"));
  EXPECT_THAT(deploy::find_kind("simulated")->methods, testing::IsEmpty());
}

TEST(Kinds, UnknownNamesAreNotFound) {
  EXPECT_EQ(deploy::find_kind("lidar"), nullptr);
  EXPECT_EQ(deploy::find_kind(""), nullptr);
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
  for (const KindInfo& kind : deploy::kinds()) {
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
