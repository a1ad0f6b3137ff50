// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/end_watch.hpp"

#include <gmock/gmock.h>

#include "tests/deploy/observation/pipeline.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// front -> fit -> map, whose corners nobody reads.
Deployment chain() {
  return deployment({service("front", lidar), service("fit", fitter, {{"scan", "front"}}),
                     service("map", mapper, {{"lines", "fit"}, {"odometry", "front"}}, "plain")});
}

EndWatch watch_of(const Deployment& deployment, const std::string& name, bool joined_late = false) {
  const Graph graph(deployment);
  for (const Connection& end : graph.ends()) {
    if (end.writer->name != name) continue;
    EndWatch watch(end, name, joined_late);
    watch.set_path(graph.path_to(*end.writer, end.output));
    return watch;
  }
  throw std::out_of_range(name);
}

/// What is known of a source "front": its processes with first number, published and lost.
std::vector<SourceInstance> front(
    const std::map<std::uint64_t, runtime::SourceLedger::Process>& processes,
    const std::string& type = "scan") {
  SourceInstance instance{"front", "front", type, {}};
  for (const auto& [incarnation, process] : processes) instance.ledger.add(incarnation, process);
  return {instance};
}

class EndOfChain : public testing::Test {
 protected:
  const Deployment deployment_ = chain();
  EndWatch watch_ = watch_of(deployment_, "map");
  Pipeline pipeline_{{"front", "fit", "map"}};
};

TEST_F(EndOfChain, CountsWhatArrives) {
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(watch_.receive(pipeline_.scan()));
  const EndFigures figures = watch_.figures(front({{11, {0, 10, 0}}}));
  EXPECT_EQ(figures.name, "map");
  EXPECT_EQ(figures.type, "corners");
  EXPECT_EQ(figures.scans_expected, 10U);
  EXPECT_EQ(figures.scans_delivered, 10U);
  EXPECT_EQ(figures.lost.sum(), 0U);
}

TEST_F(EndOfChain, MeasuresLatencyFromTheSourceToTheLastStage) {
  for (int i = 0; i < 10; ++i) watch_.receive(pipeline_.scan());
  const double two_stages = 2e-9 * Pipeline::delay;
  const EndFigures figures = watch_.figures({});
  EXPECT_NEAR(figures.latency_p50, two_stages, 0.05 * two_stages);
  EXPECT_NEAR(figures.latency_p99, two_stages, 0.05 * two_stages);
}

TEST_F(EndOfChain, PutsAGapToTheStageThatMadeFewerResults) {
  watch_.receive(pipeline_.scan());
  (void)pipeline_.scan(1);  // fit gave no result
  (void)pipeline_.scan(2);  // map gave none
  (void)pipeline_.scan(2);
  (void)pipeline_.scan();  // did not arrive
  watch_.receive(pipeline_.scan());
  const EndFigures figures = watch_.figures({});
  EXPECT_THAT(figures.lost.by_service, ElementsAre(Pair("fit", 1), Pair("map", 2)));
  EXPECT_EQ(figures.lost.on_link, 1U);
  EXPECT_EQ(figures.scans_delivered, 2U);
  EXPECT_EQ(figures.scans_expected, 6U);
}

TEST_F(EndOfChain, ARepetitionCountsForNothing) {
  const msg::Header header = pipeline_.scan();
  msg::Corners corners;
  corners.corners().resize(3);
  EXPECT_TRUE(watch_.receive(header, &corners));
  EXPECT_FALSE(watch_.receive(header, &corners));
  const EndFigures figures = watch_.figures({});
  EXPECT_EQ(figures.scans_delivered, 1U);
  EXPECT_EQ(figures.lost.sum(), 0U);
  EXPECT_EQ(figures.corners->mean_corners, 3.0);
}

TEST(EndOfMapping, SumsUpPosesAndTheNewestMap) {
  ServiceConfig slam;
  slam.name = "slam";
  EndWatch poses({.type = "pose", .writer = &slam}, "slam/pose", false);
  EndWatch maps({.type = "line_map", .writer = &slam}, "slam/line_map", false);
  Pipeline pipeline({"front", "slam"});
  msg::Pose pose;
  for (const auto status : {msg::PoseStatus::POSE_TRACKING, msg::PoseStatus::POSE_TRACKING,
                            msg::PoseStatus::POSE_AMBIGUOUS, msg::PoseStatus::POSE_LOST}) {
    pose.status(status);
    pose.pose().x(pose.pose().x() + 1.0);
    EXPECT_TRUE(poses.receive(pipeline.scan(), &pose));
  }
  const PoseFigures figures = poses.figures({}).pose.value();
  EXPECT_EQ(figures.tracking, 2U);
  EXPECT_EQ(figures.ambiguous, 1U);
  EXPECT_EQ(figures.lost, 1U);
  EXPECT_EQ(figures.status, "lost");
  EXPECT_EQ(figures.x, 4.0);

  msg::LineMap map;
  map.parts(1);
  map.lines().resize(2);
  map.lines()[0].end().x(3.0);
  map.lines()[1].id(1);
  map.lines()[1].end().y(2.0);
  for (int i = 0; i < 3; ++i) {
    (void)pipeline.scan();  // is overwritten by the next one
    EXPECT_TRUE(maps.receive(pipeline.scan(), &map));
  }
  const EndFigures end = maps.figures({});
  EXPECT_EQ(end.lost.sum(), 0U);
  EXPECT_EQ(end.map->walls, 2U);
  EXPECT_EQ(end.map->length, 5.0);
}

TEST_F(EndOfChain, ScansBeforeTheFirstThatArrivesAreLostAtTheStart) {
  for (int i = 0; i < 4; ++i) (void)pipeline_.scan(2);
  watch_.receive(pipeline_.scan());
  const EndFigures figures = watch_.figures(front({{11, {0, 5, 0}}}));
  EXPECT_EQ(figures.lost.at_start, 4U);
  EXPECT_EQ(figures.scans_expected, 5U);
}

TEST_F(EndOfChain, OfAnEndThatJoinedLateThoseAreForNobody) {
  EndWatch late = watch_of(deployment_, "map", true);
  for (int i = 0; i < 4; ++i) (void)pipeline_.scan(2);
  late.receive(pipeline_.scan());
  EXPECT_EQ(late.figures(front({{11, {0, 5, 0}}})).scans_expected, 1U);
}

TEST_F(EndOfChain, ScansBehindTheLastAreLostOnceTheSourceHasEnded) {
  for (int i = 0; i < 8; ++i) watch_.receive(pipeline_.scan());
  const auto source = front({{11, {0, 10, 0}}});
  EXPECT_EQ(watch_.figures(source).lost.at_end, 0U) << "they may be on their way";
  watch_.end();
  EXPECT_EQ(watch_.figures(source).lost.at_end, 2U);
  EXPECT_EQ(watch_.figures(source).scans_expected, 10U);
}

TEST_F(EndOfChain, ScansOfAProcessThatHasASuccessorAreLostAtItsEnd) {
  for (int i = 0; i < 8; ++i) watch_.receive(pipeline_.scan());
  constexpr std::uint64_t later = 850'000'000;  // than the last scan was published
  pipeline_.restart(0, later);
  watch_.receive(pipeline_.scan());
  const EndFigures figures = watch_.figures(front({{11, {0, 10, 0}}, {later, {0, 1, 0}}}));
  EXPECT_EQ(figures.lost.at_end, 2U);
  EXPECT_EQ(figures.scans_delivered, 9U);
  EXPECT_EQ(figures.scans_expected, 11U);
}

TEST_F(EndOfChain, WhereNothingArrivedEverythingIsLostAtTheStart) {
  EXPECT_TRUE(watch_.heard_nothing());
  const auto source = front({{11, {0, 6, 1}}});
  EXPECT_EQ(watch_.figures(source).scans_expected, 0U);
  watch_.end();
  EXPECT_EQ(watch_.figures(source).lost.at_start, 7U);
  EXPECT_EQ(watch_.figures(source).scans_expected, 7U);
}

TEST_F(EndOfChain, WhatPassesWhileItIsNoPartOfTheDeploymentIsForNobody) {
  watch_.receive(pipeline_.scan());
  watch_.interrupt();
  for (int i = 0; i < 5; ++i) (void)pipeline_.scan();
  watch_.receive(pipeline_.scan());
  EXPECT_EQ(watch_.figures(front({{11, {0, 7, 0}}})).scans_expected, 2U);
}

TEST_F(EndOfChain, KnowsTheWayOfItsMessages) {
  watch_.receive(pipeline_.scan());
  EXPECT_EQ(watch_.source_type(), "scan");
  EXPECT_EQ(watch_.topic_of("front"), "robot/front/scan");
  EXPECT_EQ(watch_.topic_of("fit"), "robot/fit/lines");
  EXPECT_EQ(watch_.topic_of("tape"), "");
  EXPECT_EQ(watch_.source_trace().service(), "front");
}

TEST_F(EndOfChain, AMessageWithoutATraceCountsForNothing) {
  EXPECT_FALSE(watch_.receive(msg::Header()));
  EXPECT_EQ(watch_.figures({}).scans_delivered, 0U);
  EXPECT_EQ(watch_.figures({}).latency_p50, 0.0);
}

TEST(EndAtItsOwnRate, CountsGapsOfItsOwnNumbersAlone) {
  const Deployment alone = deployment({service("front", lidar)});
  const Graph graph(alone);
  const Connection segments = graph.ends().back();
  ASSERT_EQ(segments.type, "segments");
  EndWatch watch(segments, "front/segments", false);
  watch.set_path(graph.path_to(*segments.writer, segments.output));
  Pipeline numbers({"front"});
  watch.receive(numbers.scan());
  (void)numbers.scan();
  watch.receive(numbers.scan());
  watch.end();
  auto sources = front({{11, {0, 1000, 0}}}, "scan");
  sources.push_back(front({{11, {0, 3, 0}}}, "segments").front());
  const EndFigures figures = watch.figures(sources);
  EXPECT_EQ(figures.scans_delivered, 2U);
  EXPECT_EQ(figures.lost.on_link, 1U);
  EXPECT_EQ(figures.scans_expected, 3U) << "the scans of the same process are not counted";
  EXPECT_FALSE(figures.corners.has_value());
}

TEST(CornerStatistics, GiveTheMeanCountAndTheMedianSizes) {
  CornerStatistics statistics;
  msg::Corners message;
  for (const double sigma : {0.001, 0.002, 0.004}) {
    msg::Corner& corner = message.corners().emplace_back();
    corner.covariance_xx(sigma * sigma);
    corner.covariance_yy(sigma * sigma);
    corner.ellipse_area(3.0 * sigma * sigma);
  }
  statistics.add(message);
  const CornerFigures figures = statistics.figures(2);
  EXPECT_EQ(figures.mean_corners, 1.5);
  EXPECT_NEAR(figures.median_sigma, 0.002, 1e-4);
  EXPECT_NEAR(figures.median_ellipse_area, 3.0 * 4e-6, 6e-7);
  EXPECT_EQ(statistics.figures(0).mean_corners, 0.0);
}

}  // namespace
}  // namespace quoin::deploy
