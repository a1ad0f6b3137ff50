// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/graph.hpp"

#include <algorithm>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/topics/topic_types.hpp"

namespace quoin {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The kinds of a robot, as far as wiring goes. The types are some of the table; what `lidar` gives
// at its own rate stands for odometry.
const KindInfo lidar{
    .name = "lidar", .description = "", .outputs = {{"scan"}, {"lines", Rate::own_rate}}};
const KindInfo walls{
    .name = "walls", .description = "", .inputs = {{"scan", "scan"}}, .outputs = {{"segments"}}};
const KindInfo fitter{.name = "fitter",
                      .description = "",
                      .inputs = {{"segments", "segments"}},
                      .outputs = {{"lines"}}};
const KindInfo pose{.name = "pose",
                    .description = "",
                    .inputs = {{"lines", "lines"},
                               {"odometry", "lines", Join::by_time},
                               {"map", "corners", Join::latest, false}},
                    .outputs = {{"corners"}}};
const KindInfo mapper{.name = "mapper",
                      .description = "",
                      .inputs = {{"lines", "lines"}},
                      .outputs = {{"corners", Rate::own_rate}}};
const KindInfo tape{.name = "tape", .description = "", .observer = true};

ServiceConfig service(const std::string& name, const KindInfo* kind,
                      std::vector<InputConfig> inputs = {}) {
  ServiceConfig config;
  config.name = name;
  config.kind = kind == nullptr ? "unknown" : kind->name;
  config.info = kind;
  config.inputs = std::move(inputs);
  if (kind == nullptr) return config;
  for (const OutputPort& port : kind->outputs) {
    config.outputs.push_back(
        {port.type, output_topic("robot", name, port.type), "feature", port.rate});
  }
  return config;
}

ServiceConfig instance(ServiceConfig config, int strength) {
  config.strength = strength;
  return config;
}

InputConfig by(const std::string& port, const std::string& writer) { return {port, writer, {}}; }

/// front -> segments -> wctls -> where, with odometry of front; mapping beside it; a tape of all.
std::vector<ServiceConfig> robot() {
  return {service("front", &lidar),
          service("segments", &walls, {by("scan", "front")}),
          service("wctls", &fitter, {by("segments", "segments")}),
          service("where", &pose, {by("lines", "wctls"), by("odometry", "front")}),
          service("mapping", &mapper, {by("lines", "wctls")}),
          service("tape", &tape, {by("", "front"), by("", "where")})};
}

std::vector<std::string> labels(const std::vector<const ServiceConfig*>& services) {
  std::vector<std::string> texts;
  for (const ServiceConfig* each : services) texts.push_back(label(*each));
  return texts;
}

/// "front/scan", the output of each.
std::vector<std::string> texts(const std::vector<Connection>& connections) {
  std::vector<std::string> texts;
  for (const Connection& each : connections)
    texts.push_back(each.writer->name + "/" + each.output.type);
  return texts;
}

const ServiceConfig& named(const std::vector<ServiceConfig>& services, std::string_view name) {
  return *std::ranges::find(services, name, &ServiceConfig::name);
}

TEST(Graph, InputsComeBeforeTheirReadersElseAsTheyWere) {
  auto services = robot();
  std::ranges::reverse(services);
  EXPECT_THAT(labels(Graph(services).order()),
              ElementsAre("front", "segments", "wctls", "mapping", "where", "tape"));
  services = robot();
  EXPECT_THAT(labels(Graph(services).order()),
              ElementsAre("front", "segments", "wctls", "where", "mapping", "tape"));
}

TEST(Graph, StrongInstancesComeBeforeWeakOnes) {
  const std::vector<ServiceConfig> services{
      instance(service("fit", &fitter, {by("segments", "walls")}), 1),
      instance(service("fit", &fitter, {by("segments", "walls")}), 3), service("walls", &walls)};
  EXPECT_THAT(labels(Graph(services).order()), ElementsAre("walls", "fit@3", "fit@1"));
}

TEST(Graph, TheLevelIsTheLongestWayFromASource) {
  const auto services = robot();
  const Graph graph(services);
  EXPECT_EQ(graph.level(named(services, "front")), 0);
  EXPECT_EQ(graph.level(named(services, "segments")), 1);
  EXPECT_EQ(graph.level(named(services, "wctls")), 2);
  EXPECT_EQ(graph.level(named(services, "where")), 3) << "though it reads front, too";
  EXPECT_EQ(graph.level(named(services, "mapping")), 3);
}

TEST(Graph, ObserversAreBehindAllOthersWhateverTheyRead) {
  auto services = robot();
  services.push_back(service("scans_only", &tape, {by("", "front")}));
  const Graph graph(services);
  for (const ServiceConfig& each : services) {
    if (each.info == &tape) continue;
    EXPECT_GT(graph.level(named(services, "tape")), graph.level(each));
    EXPECT_GT(graph.level(named(services, "scans_only")), graph.level(each));
  }
}

TEST(Graph, AConnectionKnowsBothEnds) {
  const auto services = robot();
  const auto inputs = Graph(services, "robot").inputs_of(named(services, "where"));
  ASSERT_EQ(inputs.size(), 2U) << "the optional port is not wired";
  EXPECT_EQ(inputs[0].reader->name, "where");
  EXPECT_EQ(inputs[0].port, "lines");
  EXPECT_EQ(inputs[0].join, Join::each);
  EXPECT_EQ(inputs[0].output.topic, "robot/wctls/lines");
  EXPECT_EQ(inputs[1].port, "odometry");
  EXPECT_EQ(inputs[1].type, "lines");
  EXPECT_EQ(inputs[1].join, Join::by_time);
  EXPECT_EQ(inputs[1].writer->name, "front");
  EXPECT_EQ(inputs[1].output.topic, "robot/front/lines");
}

TEST(Graph, AnObserverHasOneConnectionForEachTopic) {
  const auto services = robot();
  const auto inputs = Graph(services).inputs_of(named(services, "tape"));
  EXPECT_THAT(texts(inputs), ElementsAre("front/scan", "front/lines", "where/corners"));
  EXPECT_EQ(inputs[0].port, "");
}

TEST(Graph, OfAWriterOfUnknownKindAnObserverReadsAnyTypeThereIs) {
  const std::vector<ServiceConfig> services{service("other", nullptr),
                                            service("tape", &tape, {by("", "other")})};
  const auto inputs = Graph(services, "robot").inputs_of(services[1]);
  ASSERT_EQ(inputs.size(), topics::topic_types().size());
  EXPECT_EQ(inputs[0].output.topic, "robot/other/" + std::string(topics::topic_types()[0].name));
}

TEST(Graph, APortReadsTheTypeThatItNeedsOfAWriterOfUnknownKind) {
  std::vector<ServiceConfig> services{service("other", nullptr),
                                      service("segments", &walls, {by("scan", "other")})};
  services[0].qos = "lossless";
  const auto inputs = Graph(services, "robot").inputs_of(services[1]);
  ASSERT_EQ(inputs.size(), 1U);
  EXPECT_EQ(inputs[0].output.topic, "robot/other/scan");
  EXPECT_EQ(inputs[0].output.qos, "lossless");
}

TEST(Graph, TheStrongestInstanceIsTheWriter) {
  const std::vector<ServiceConfig> services{instance(service("front", &lidar), 1),
                                            instance(service("front", &lidar), 2),
                                            service("segments", &walls, {by("scan", "front")})};
  const auto inputs = Graph(services).inputs_of(services[2]);
  ASSERT_EQ(inputs.size(), 1U);
  EXPECT_EQ(label(*inputs[0].writer), "front@2");
  EXPECT_EQ(label(Graph(services).source_of(services[2])), "front@2");
}

TEST(Graph, ReadersAreThoseOfAnyPortOrOfOneType) {
  const auto services = robot();
  const Graph graph(services);
  EXPECT_THAT(labels(graph.readers_of("front")), ElementsAre("segments", "where", "tape"));
  EXPECT_THAT(labels(graph.readers_of("front", "scan")), ElementsAre("segments", "tape"));
  EXPECT_THAT(labels(graph.readers_of("front", "lines")), ElementsAre("where", "tape"));
  EXPECT_THAT(labels(graph.readers_of("mapping")), IsEmpty());
}

TEST(Graph, EachPortIsAReaderAndAnObserverOneForEachOutput) {
  auto services = robot();
  const auto expected = [&](const std::string& name) {
    return Graph(services).expected_readers(named(services, name));
  };
  EXPECT_EQ(expected("front"), 4U) << "segments, where, and two of the tape";
  EXPECT_EQ(expected("wctls"), 2U);
  EXPECT_EQ(expected("where"), 1U);
  EXPECT_EQ(expected("mapping"), 0U);
  services.push_back(service("both", &pose, {by("lines", "wctls"), by("odometry", "wctls")}));
  EXPECT_EQ(expected("wctls"), 4U) << "two ports of one service";
}

TEST(Graph, ReadersOfUnknownKindsAndAllInstancesAreExpected) {
  std::vector<ServiceConfig> services{
      service("front", &lidar),
      service("short", nullptr, {by("input", "front")}),
      service("long", nullptr, {by("a", "front"), by("b", "front")}),
      service("listing", nullptr, {by("", "front")}),
      instance(service("fit", nullptr, {by("input", "front")}), 1),
      instance(service("fit", nullptr, {by("input", "front")}), 2)};
  EXPECT_EQ(Graph(services).expected_readers(services[0]), 1U + 2U + 2U + 2U);
  services[3].observes_all = true;
  EXPECT_EQ(Graph(services).expected_readers(services[0]), 7U);
}

TEST(Graph, TheSourceIsFoundByTheFirstEachPort) {
  auto services = robot();
  services.insert(services.begin(), service("rear", &lidar));
  services[4].inputs = {by("odometry", "rear"), by("lines", "wctls")};  // where, in an odd order
  const Graph graph(services);
  ASSERT_EQ(services[4].name, "where");
  EXPECT_EQ(graph.source_of(services[4]).name, "front");
  EXPECT_EQ(graph.source_of(named(services, "rear")).name, "rear");
  EXPECT_EQ(graph.source_of(named(services, "tape")).name, "tape")
      << "an observer's is of no meaning";
}

TEST(Graph, UpstreamIsTheNearestThatGivesTheType) {
  const auto services = robot();
  const Graph graph(services);
  const ServiceConfig& where = named(services, "where");
  EXPECT_EQ(graph.upstream(where, "corners"), &where);
  EXPECT_EQ(graph.upstream(where, "lines")->name, "wctls")
      << "front gives lines, too, but further on";
  EXPECT_EQ(graph.upstream(where, "scan")->name, "front");
  EXPECT_EQ(graph.upstream(named(services, "segments"), "corners"), nullptr);
}

TEST(Graph, APathBeginsWithTheOutputThatNumbersTheMessages) {
  auto services = robot();
  services.push_back(service("landmarks", &tape));
  const KindInfo filter{.name = "filter",
                        .description = "",
                        .inputs = {{"corners", "corners"}},
                        .outputs = {{"segments"}}};
  services.push_back(service("filtered", &filter, {by("corners", "mapping")}));
  const Graph graph(services);
  const auto path = [&](const std::string& name, std::string_view type) {
    const ServiceConfig& writer = named(services, name);
    return texts(graph.path_to(writer, *writer.output(type)));
  };
  EXPECT_THAT(path("where", "corners"),
              ElementsAre("front/scan", "segments/segments", "wctls/lines", "where/corners"));
  EXPECT_THAT(path("front", "scan"), ElementsAre("front/scan"));
  EXPECT_THAT(path("front", "lines"), ElementsAre("front/lines"));
  EXPECT_THAT(path("mapping", "corners"), ElementsAre("mapping/corners")) << "at its own rate";
  EXPECT_THAT(path("filtered", "segments"), ElementsAre("mapping/corners", "filtered/segments"));
}

TEST(Graph, EndsAreTheOutputsThatNoServiceButObserversReads) {
  auto services = robot();
  EXPECT_THAT(texts(Graph(services).ends()), ElementsAre("where/corners", "mapping/corners"));
  services[3].inputs.pop_back();  // where reads no odometry
  EXPECT_THAT(texts(Graph(services).ends()),
              ElementsAre("front/lines", "where/corners", "mapping/corners"))
      << "one of two outputs";
}

TEST(Graph, AnEndOfSeveralInstancesIsOneOfTheStrongest) {
  const std::vector<ServiceConfig> services{
      service("front", &walls), instance(service("fit", &fitter, {by("segments", "front")}), 1),
      instance(service("fit", &fitter, {by("segments", "front")}), 2)};
  const auto ends = Graph(services).ends();
  ASSERT_THAT(texts(ends), ElementsAre("fit/lines"));
  EXPECT_EQ(label(*ends[0].writer), "fit@2");
}

TEST(Graph, WhatAStrangerWritesIsNoEnd) {
  ServiceConfig stranger = service("camera", &external_kind());
  stranger.outputs = {{"scan", "rt/scan", "best_effort"}};
  const std::vector<ServiceConfig> services{stranger};
  EXPECT_THAT(Graph(services).ends(), IsEmpty());
}

/// Of services that may form cycles: by their names, what they read.
std::vector<std::vector<std::string>> cycles(
    const std::vector<std::pair<std::string, std::vector<std::string>>>& wiring) {
  std::vector<ServiceConfig> services;
  for (const auto& [name, reads] : wiring) {
    ServiceConfig& added = services.emplace_back(service(name, nullptr));
    for (const std::string& other : reads) added.inputs.push_back(by("port", other));
  }
  std::vector<std::vector<std::string>> found;
  for (const auto& cycle : Graph(services).cycles()) found.push_back(labels(cycle));
  return found;
}

TEST(GraphCycles, ThereAreNoneWhereServicesReadTwoOfOneSource) {
  EXPECT_THAT(cycles({{"a", {}}, {"b", {"a"}}, {"c", {"a", "b"}}, {"d", {"c", "b", "a"}}}),
              IsEmpty());
}

TEST(GraphCycles, AServiceMayReadItself) {
  EXPECT_THAT(cycles({{"a", {"a"}}}), ElementsAre(ElementsAre("a")));
}

TEST(GraphCycles, EachIsFoundOnceWhereverOneBegins) {
  EXPECT_THAT(cycles({{"x", {"b"}}, {"a", {"c"}}, {"b", {"a"}}, {"c", {"b"}}}),
              ElementsAre(ElementsAre("b", "a", "c")));
}

TEST(GraphCycles, AreFoundThroughAnyPort) {
  EXPECT_THAT(cycles({{"s", {}}, {"a", {"s", "b"}}, {"b", {"s", "a"}}}),
              ElementsAre(ElementsAre("a", "b")));
}

TEST(GraphCycles, TwoThatHaveNothingInCommonAreBothFound) {
  EXPECT_THAT(cycles({{"a", {"b"}}, {"b", {"a"}}, {"c", {"d", "a"}}, {"d", {"c"}}}),
              ElementsAre(ElementsAre("a", "b"), ElementsAre("c", "d")));
}

TEST(GraphCycles, WhatIsInThemIsLeftOutOfTheOrder) {
  const std::vector<ServiceConfig> services{
      service("s", nullptr), service("a", nullptr, {by("p", "b"), by("q", "s")}),
      service("b", nullptr, {by("p", "a")}), service("c", nullptr, {by("p", "s")}),
      service("behind", nullptr, {by("p", "b")})};
  const Graph graph(services);
  EXPECT_THAT(labels(graph.order()), ElementsAre("s", "c"));
  EXPECT_EQ(graph.level(services[1]), 0);
}

TEST(GraphCycles, NoWayThroughThemIsEndless) {
  const std::vector<ServiceConfig> services{service("a", &walls, {by("scan", "b")}),
                                            service("b", &walls, {by("scan", "a")})};
  const Graph graph(services);
  EXPECT_LE(graph.path_to(services[0], services[0].outputs[0]).size(), 3U);
  EXPECT_EQ(graph.upstream(services[0], "corners"), nullptr);
  (void)graph.source_of(services[0]);
}

}  // namespace
}  // namespace quoin
