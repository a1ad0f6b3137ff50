// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/plan.hpp"

#include <gmock/gmock.h>

#include "deploy/kinds/kinds.hpp"

namespace quoin::deploy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr auto front = "  - {name: front, kind: simulated, parameters: {rate_hz: 10}}\n";
constexpr auto walls =
    "  - {name: walls, kind: segmentation, input: front, method: iepf, parameters: "
    "{split_distance: "
    "40 mm}}\n";
constexpr auto lines = "  - {name: lines, kind: line_fitting, input: walls, method: wctls}\n";

Deployment deployment(const std::string& services, const std::string& head = "",
                      const std::string& file = "/robots/robot.yaml") {
  return deploy::parse_deployment("version: 1\n" + head + "services:\n" + services, file);
}

std::vector<std::string> plan(const Deployment& running, const Deployment& wanted) {
  std::vector<std::string> texts;
  for (const Change& change : plan_changes(running, wanted).changes)
    texts.push_back(to_text(change));
  return texts;
}

std::vector<std::string> plan(const std::string& running, const std::string& wanted) {
  return plan(deployment(running), deployment(wanted));
}

const std::string chain = std::string(front) + walls + lines;

TEST(Plan, KeepsWhatMeansTheSame) {
  const std::string same = std::string("  - {kind: simulated, name: front}\n") + lines +
                           "  - {name: walls, kind: segmentation, input: front, parameters: "
                           "{split_distance: 4 cm}}\n";
  EXPECT_THAT(plan(chain, same), ElementsAre("keep front", "keep walls", "keep lines"));
  EXPECT_TRUE(plan_changes(deployment(chain), deployment(same)).nothing_to_do());
}

TEST(Plan, ExchangesMethodsAndParametersInPlace) {
  const std::string wanted =
      std::string(front) +
      "  - {name: walls, kind: segmentation, input: front, method: iepf}\n"
      "  - {name: lines, kind: line_fitting, input: walls, method: utls, parameters: {covariance: "
      "as_published}}\n";
  EXPECT_THAT(plan(chain, wanted),
              ElementsAre("keep front", HasSubstr("swap walls: split_distance="),
                          "swap lines: method wctls -> utls, covariance=as_published"));
}

TEST(Plan, StartsWhatIsNewAndStopsWhatIsGone) {
  const std::string wanted = std::string(front) + walls +
                             "  - {name: cwlf, kind: line_fitting, input: walls, method: cwlf}\n";
  EXPECT_THAT(plan(chain, wanted),
              ElementsAre("keep front", "keep walls", "start cwlf: line_fitting/cwlf reads walls",
                          "stop lines"));
}

TEST(Plan, ReplacesTheProcessOfASourceWithOtherParameters) {
  const std::string wanted =
      std::string("  - {name: front, kind: simulated, parameters: {rate_hz: 20}}\n") + walls +
      lines;
  const Plan result = plan_changes(deployment(chain), deployment(wanted));
  EXPECT_EQ(to_text(result.of("front")), "replace front: rate_hz=20");
  EXPECT_TRUE(result.of("front").same_scans);
  EXPECT_EQ(result.of("walls").action, ChangeAction::keep);
}

TEST(Plan, ReplacesWhatReadsAnotherInput) {
  const std::string two = chain + "  - {name: hough, kind: segmentation, input: front}\n";
  const std::string wanted = std::string(front) + walls +
                             "  - {name: hough, kind: segmentation, input: front}\n" +
                             "  - {name: lines, kind: line_fitting, input: hough, method: utls}\n";
  const Plan result = plan_changes(deployment(two), deployment(wanted));
  EXPECT_EQ(to_text(result.of("lines")),
            "replace lines: input walls -> hough, method wctls -> utls");
  EXPECT_TRUE(result.of("lines").same_scans);
}

TEST(Plan, AnotherSourceHasOtherScans) {
  const std::string rear = "  - {name: rear, kind: simulated}\n";
  const std::string wanted = front + rear +
                             "  - {name: walls, kind: segmentation, input: rear, parameters: "
                             "{split_distance: 40 mm}}\n" +
                             lines;
  const Plan result = plan_changes(deployment(chain), deployment(wanted));
  EXPECT_EQ(result.of("walls").action, ChangeAction::replace);
  EXPECT_FALSE(result.of("walls").same_scans);
  EXPECT_EQ(result.of("lines").action, ChangeAction::keep) << "it reads the same topic";
}

TEST(Plan, AnotherPresetReplacesTheReaderToo) {
  const Plan result = plan_changes(
      deployment(chain), deployment(std::string(front) +
                                    "  - {name: walls, kind: segmentation, input: front, qos: "
                                    "lossless, parameters: {split_distance: 40 mm}}\n" +
                                    lines));
  EXPECT_EQ(to_text(result.of("walls")), "replace walls: qos feature -> lossless");
  EXPECT_EQ(to_text(result.of("lines")), "replace lines: qos of walls feature -> lossless");
}

TEST(Plan, TheRestartPolicyIsTheSupervisorsBusiness) {
  const std::string wanted =
      std::string(front) + walls +
      "  - {name: lines, kind: line_fitting, input: walls, method: wctls, restart: never}\n";
  EXPECT_THAT(plan(chain, wanted),
              ElementsAre("keep front", "keep walls", "adjust lines: restart always -> never"));
  EXPECT_TRUE(plan_changes(deployment(chain), deployment(wanted)).nothing_to_do());
}

TEST(Plan, NamespaceDomainAndDistributionStay) {
  const auto obstacles = [](const std::string& head) {
    return plan_changes(deployment(chain, "namespace: a\ndomain: 1\n"), deployment(chain, head))
        .obstacles;
  };
  EXPECT_THAT(obstacles("namespace: a\ndomain: 1\n"), IsEmpty());
  EXPECT_THAT(obstacles("namespace: b\ndomain: 1\n"),
              ElementsAre(HasSubstr("the namespace cannot be changed from 'a' to 'b'")));
  EXPECT_THAT(obstacles("namespace: a\ndomain: 2\n"),
              ElementsAre(HasSubstr("the domain cannot be changed from 1 to 2")));
  EXPECT_THAT(obstacles("namespace: a\ndomain: 1\nros: {distro: iron}\n"),
              ElementsAre(HasSubstr("the distribution of ROS 2 cannot be changed")));
}

TEST(Plan, CountsInstancesAndHostsApart) {
  const auto fitters = [](const std::string& more) {
    return deployment(
        "  - {name: front, kind: simulated, host: a}\n"
        "  - {name: walls, kind: segmentation, input: front, host: b}\n"
        "  - {name: fit, kind: line_fitting, input: walls, host: b, strength: 2}\n" +
            more,
        "network: {interfaces: [lo]}\n");
  };
  const Deployment one = fitters("");
  const Deployment two =
      fitters("  - {name: fit, kind: line_fitting, input: walls, host: b, strength: 1}\n");
  const Plan here = plan_changes(one, two, "b");
  EXPECT_THAT(here.obstacles, IsEmpty());
  EXPECT_EQ(here.of("fit@2").action, ChangeAction::keep);
  EXPECT_EQ(here.of("fit@1").action, ChangeAction::start);
  EXPECT_EQ(plan_changes(one, two, "a").changes.size(), 1U);
  EXPECT_EQ(plan_changes(two, one, "b").of("fit@1").action, ChangeAction::stop);
  const Deployment shared = deployment(
      "  - {name: front, kind: simulated, host: a}\n"
      "  - {name: walls, kind: segmentation, input: front, host: b}\n"
      "  - {name: fit, kind: line_fitting, input: walls, host: b}\n",
      "network: {interfaces: [lo]}\n");
  EXPECT_THAT(plan_changes(one, shared, "b").obstacles,
              ElementsAre(HasSubstr("strength and lease of service 'fit' cannot be changed")));
}

TEST(Plan, AProcessOfSeveralServicesIsReplacedAsAWhole) {
  const std::string together = chain + "processes: {perception: [walls, lines]}\n";
  EXPECT_THAT(plan(chain, together),
              ElementsAre("keep front", "replace walls: process its own -> perception",
                          "replace lines: process its own -> perception"));
  EXPECT_THAT(plan(together, together), ElementsAre("keep front", "keep walls", "keep lines"));
  const std::string swapped = std::string(front) + walls +
                              "  - {name: lines, kind: line_fitting, input: walls, method: utls}\n"
                              "processes: {perception: [walls, lines]}\n";
  EXPECT_THAT(plan(together, swapped),
              ElementsAre("keep front", "keep walls", "swap lines: method wctls -> utls"));
  const std::string more = chain +
                           "  - {name: utls, kind: line_fitting, input: walls, method: utls}\n"
                           "processes: {perception: [walls, lines, utls]}\n";
  EXPECT_THAT(plan(together, more),
              ElementsAre("keep front", "replace walls: with its process perception",
                          "replace lines: with its process perception", HasSubstr("start utls")));
  EXPECT_THAT(
      plan(together, std::string(front) + walls + "processes: {perception: [walls]}\n"),
      ElementsAre("keep front", "replace walls: with its process perception", "stop lines"));
}

}  // namespace
}  // namespace quoin::deploy
