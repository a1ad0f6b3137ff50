// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/node.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

const Node::Settings walls{.service = "walls", .method = "iepf"};

/// A source, a node and the topic of its results.
class NodeTest : public testing::Test {
 protected:
  void make(MethodFactory factory = nothing_to_do(), bool lossless = false) {
    stage_.emplace(walls, std::move(factory),
                   outputs(output_part(segments_, Rate::per_input, lossless)));
    stage_->node().open(inputs(input_part({"scan", "scan"}, "front", queue_)));
  }
  void publish(const msg::Scan& scan) {
    queue_->push(scan);
    stage_->run();
  }
  void publish() { publish(front_.next()); }

  Numbered<msg::Scan> front_{"front"};
  std::shared_ptr<MemoryQueue<msg::Scan>> queue_ = std::make_shared<MemoryQueue<msg::Scan>>();
  std::shared_ptr<MemoryTopic<msg::Segments>> segments_ =
      std::make_shared<MemoryTopic<msg::Segments>>();
  std::optional<Stage> stage_;
};

TEST_F(NodeTest, EachMessageGivesOneResultWithItsHeader) {
  make();
  for (int i = 0; i < 3; ++i) publish();
  ASSERT_THAT(numbers(segments_->written), ElementsAre(0, 1, 2));
  const msg::Header& header = segments_->written[2].header();
  ASSERT_EQ(header.origins().size(), 1U);
  EXPECT_EQ(header.origins()[0].source(), "front");
  EXPECT_EQ(header.origins()[0].incarnation(), front_.incarnation());
  EXPECT_EQ(header.stamp(), 200 * millisecond);
  EXPECT_EQ(header.frame(), "laser");
  ASSERT_EQ(header.trace().size(), 2U);
  EXPECT_EQ(header.trace()[0].service(), "front");
  const msg::StageTrace& trace = header.trace()[1];
  EXPECT_EQ(trace.service(), "walls");
  EXPECT_EQ(trace.input(), "scan");
  EXPECT_EQ(trace.method(), "iepf");
  EXPECT_EQ(trace.incarnation(), stage_->record().incarnation());
  EXPECT_EQ(trace.index(), 2U);
  EXPECT_GE(trace.received(), header.trace()[0].published());
  EXPECT_GE(trace.published(), trace.received());
  const msg::ServiceStatus status = stage_->status();
  EXPECT_EQ(status.received(), 3U);
  EXPECT_EQ(status.published(), 3U);
  EXPECT_EQ(status.lost(), 0U);
  EXPECT_EQ(status.inputs()[0].received(), 3U);
  EXPECT_EQ(status.outputs()[0].published(), 3U);
}

TEST_F(NodeTest, TheMethodFillsTheResultFromTheMessage) {
  make(always([](Work& work) {
    EXPECT_EQ(work.port(), "scan");
    work.output<msg::Segments>().scan_points(
        static_cast<std::uint32_t>(work.input<msg::Scan>().ranges().size()));
    work.fail(2);
  }));
  msg::Scan scan = front_.next();
  scan.ranges() = {1.0F, 2.0F, 3.0F};
  publish(scan);
  EXPECT_EQ(segments_->written.at(0).scan_points(), 3U);
  EXPECT_EQ(stage_->status().failures(), 2U);
}

TEST_F(NodeTest, CountsWhatIsMissingByWhereItWasLost) {
  make();
  publish();
  (void)front_.next();
  (void)front_.next();  // published, did not arrive
  publish();
  front_.lose();  // not published
  publish();
  const msg::ServiceStatus status = stage_->status();
  EXPECT_EQ(status.received(), 3U);
  EXPECT_EQ(status.lost(), 2U);
  EXPECT_EQ(status.upstream_lost(), 1U);
  EXPECT_THAT(stage_->losses(), ElementsAre(Pair("link", 2)));
  EXPECT_EQ(status.inputs()[0].lost(), 2U);
  EXPECT_EQ(status.inputs()[0].upstream_lost(), 1U);
  EXPECT_THAT(indices(segments_->written), ElementsAre(0, 1, 2)) << "of results, not of scans";
}

TEST_F(NodeTest, WhatComesTwiceIsHandledOnce) {
  make();
  const msg::Scan first = front_.next();
  publish(first);
  publish(first);
  publish();
  publish(first);
  EXPECT_THAT(numbers(segments_->written), ElementsAre(0, 1));
  EXPECT_EQ(stage_->status().inputs()[0].duplicates(), 2U);
  EXPECT_EQ(stage_->status().received(), 2U);
}

TEST_F(NodeTest, AMessageWhoseMethodThrowsIsLostInProcessing) {
  make(always([](Work& work) {
    if (topics::sequence_number(*work.message().header) == 1) throw std::runtime_error("singular");
  }));
  for (int i = 0; i < 3; ++i) publish();
  EXPECT_THAT(numbers(segments_->written), ElementsAre(0, 2));
  EXPECT_THAT(indices(segments_->written), ElementsAre(0, 1)) << "only results are numbered";
  EXPECT_THAT(stage_->losses(), ElementsAre(Pair("processing", 1)));
  EXPECT_EQ(stage_->status().published(), 2U);
}

TEST_F(NodeTest, AResultThatIsNotTakenIsLostInPublishing) {
  make();
  publish();
  segments_->room = [] { return false; };
  publish();
  segments_->room = [] { return true; };
  publish();
  EXPECT_THAT(numbers(segments_->written), ElementsAre(0, 2));
  EXPECT_THAT(indices(segments_->written), ElementsAre(0, 1));
  EXPECT_THAT(stage_->losses(), ElementsAre(Pair("publishing", 1)));
  EXPECT_EQ(stage_->status().outputs()[0].lost(), 1U);
}

TEST_F(NodeTest, AskingForAPortOrTypeThatIsNotTheKindsIsAnErrorOfTheMethod) {
  make(always([](Work& work) {
    switch (topics::sequence_number(*work.message().header)) {
      case 0:
        (void)work.input<msg::Lines>();
        break;
      case 1:
        (void)work.output<msg::Lines>();
        break;
      default:
        break;
    }
  }));
  for (int i = 0; i < 3; ++i) publish();
  EXPECT_THAT(numbers(segments_->written), ElementsAre(2));
  EXPECT_THAT(stage_->losses(), ElementsAre(Pair("processing", 2)));
}

TEST_F(NodeTest, ARestartedSourceIsFollowedFromItsFirstMessageOn) {
  make();
  for (int i = 0; i < 5; ++i) publish();
  front_.restart();
  (void)front_.next();
  publish();
  EXPECT_THAT(numbers(segments_->written), ElementsAre(0, 1, 2, 3, 4, 1));
  EXPECT_EQ(stage_->status().lost(), 1U) << "its first one did not arrive";
  EXPECT_THAT(indices(segments_->written), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST_F(NodeTest, TellsWhatItsEndpointsKnow) {
  make();
  (void)segments_->subscribe();
  (void)segments_->subscribe();
  segments_->incompatible = {"test/segments: reliable, asked for best effort"};
  queue_->writers = 3;
  queue_->incompatible = {"test/scan: volatile, asked for transient local"};
  EXPECT_EQ(stage_->node().matched_readers(), 2U);
  EXPECT_EQ(stage_->node().matched_writers(), 3U);
  msg::ServiceStatus status = stage_->status();
  stage_->node().report_endpoints(status);
  EXPECT_EQ(status.outputs()[0].readers(), 2U);
  EXPECT_EQ(status.inputs()[0].writers(), 3U);
  EXPECT_THAT(status.incompatible_qos(),
              ElementsAre(segments_->incompatible[0], queue_->incompatible[0]));
  stage_->node().assert_liveliness();
  EXPECT_EQ(segments_->liveliness, 1U);
}

TEST_F(NodeTest, DrainingHandlesAllThatHasCome) {
  make();
  for (int i = 0; i < 10; ++i) queue_->push(front_.next());
  stage_->node().drain();
  EXPECT_EQ(segments_->written.size(), 10U);
  EXPECT_EQ(queue_->size(), 0U);
}

TEST(NodeOutputs, EachHasItsOwnNumbersAndCounts) {
  Numbered<msg::Scan> front("front");
  const auto queue = std::make_shared<MemoryQueue<msg::Scan>>();
  const auto segments = std::make_shared<MemoryTopic<msg::Segments>>();
  const auto lines = std::make_shared<MemoryTopic<msg::Lines>>();
  Stage stage(walls, nothing_to_do(), outputs(output_part(segments), output_part(lines)));
  stage.node().open(inputs(input_part({"scan", "scan"}, "front", queue)));
  for (int i = 0; i < 4; ++i) {
    lines->room = [i] { return i != 1; };
    queue->push(front.next());
    stage.run();
  }
  EXPECT_THAT(numbers(segments->written), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(indices(segments->written), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(numbers(lines->written), ElementsAre(0, 2, 3));
  EXPECT_THAT(indices(lines->written), ElementsAre(0, 1, 2));
  const msg::ServiceStatus status = stage.status();
  EXPECT_EQ(status.outputs()[0].published(), 4U);
  EXPECT_EQ(status.outputs()[0].lost(), 0U);
  EXPECT_EQ(status.outputs()[1].published(), 3U);
  EXPECT_EQ(status.outputs()[1].lost(), 1U);
  EXPECT_EQ(status.published() + status.lost(), status.received());
}

/// A node that publishes a map every third message.
class OwnRate : public testing::Test {
 protected:
  OwnRate() { stage_.node().open(inputs(input_part({"scan", "scan"}, "front", queue_))); }
  void publish(int count) {
    for (int i = 0; i < count; ++i) queue_->push(front_.next());
    stage_.run();
  }

  Numbered<msg::Scan> front_{"front"};
  std::shared_ptr<MemoryQueue<msg::Scan>> queue_ = std::make_shared<MemoryQueue<msg::Scan>>();
  std::shared_ptr<MemoryTopic<msg::Segments>> segments_ =
      std::make_shared<MemoryTopic<msg::Segments>>();
  std::shared_ptr<MemoryTopic<msg::Lines>> map_ = std::make_shared<MemoryTopic<msg::Lines>>();
  Stage stage_{walls, always([](Work& work) {
                 if (topics::sequence_number(*work.message().header) % 3 == 2)
                   work.publish<msg::Lines>();
               }),
               outputs(output_part(segments_), output_part(map_, Rate::own_rate))};
};

TEST_F(OwnRate, GoesOutWhenTheMethodSaysSo) {
  publish(7);
  EXPECT_EQ(segments_->written.size(), 7U);
  ASSERT_EQ(map_->written.size(), 2U);
  EXPECT_EQ(stage_.status().published(), 7U);
  EXPECT_EQ(stage_.status().lost(), 0U);
  EXPECT_EQ(stage_.status().outputs()[1].published(), 2U);
}

TEST_F(OwnRate, IsNumberedByTheNodeAndNamesWhatItWasMadeFrom) {
  publish(6);
  ASSERT_THAT(numbers(map_->written), ElementsAre(0, 1));
  const msg::Header& header = map_->written[1].header();
  ASSERT_EQ(header.origins().size(), 2U);
  EXPECT_EQ(header.origins()[0].source(), "walls");
  EXPECT_EQ(header.origins()[0].incarnation(), stage_.record().incarnation());
  EXPECT_EQ(header.origins()[1].source(), "front");
  EXPECT_EQ(header.origins()[1].sequence_number(), 5U);
  EXPECT_EQ(header.stamp(), 500 * millisecond);
  EXPECT_EQ(header.frame(), "laser");
  ASSERT_EQ(header.trace().size(), 1U) << "its way begins here";
  EXPECT_EQ(header.trace()[0].service(), "walls");
  EXPECT_EQ(header.trace()[0].index(), 1U);
}

TEST(OwnRateOutput, MayGiveSeveralMessagesAtATimeInAFrameOfItsOwn) {
  const auto scans = std::make_shared<MemoryQueue<msg::Scan>>();
  const auto results = std::make_shared<MemoryTopic<msg::Segments>>();
  const auto map = std::make_shared<MemoryTopic<msg::Lines>>();
  Stage stage({.service = "map"}, always([](Work& work) {
                work.set_frame("hall");
                work.publish_while<msg::Lines>([left = 3](msg::Lines& out) mutable {
                  out.covariance_mode(std::to_string(left));
                  return left-- > 0;
                });
              }),
              outputs(output_part(results), output_part(map, Rate::own_rate)));
  stage.node().open(inputs(input_part({"scan", "scan"}, "front", scans)));
  Numbered<msg::Scan> front("front");
  scans->push(front.next());
  scans->push(front.next());
  stage.run();
  ASSERT_THAT(numbers(map->written), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(map->written[1].covariance_mode(), "2");
  EXPECT_EQ(map->written[3].covariance_mode(), "3");
  EXPECT_EQ(map->written[4].header().frame(), "hall");
  EXPECT_EQ(results->written.at(1).header().frame(), "hall");
  EXPECT_EQ(stage.status().published(), 2U);
  EXPECT_EQ(stage.status().outputs()[1].published(), 6U);
}

TEST_F(OwnRate, ItsReaderAccountsForItByItsOwnNumbers) {
  publish(9);
  ASSERT_EQ(map_->written.size(), 3U);
  ScanAccounting accounting;
  accounting.receive(map_->written[0].header());
  const auto losses = accounting.receive(map_->written[2].header());
  ASSERT_EQ(losses.size(), 1U);
  EXPECT_EQ(losses[0].site, (LossSite{LossPlace::link}));
  EXPECT_EQ(losses[0].count, 1U);
}

TEST(NodeOutputs, WithoutAnyNothingIsPublishedAndNothingLost) {
  Numbered<msg::Scan> front("front");
  const auto queue = std::make_shared<MemoryQueue<msg::Scan>>();
  Stage stage({.service = "tape"}, nothing_to_do());
  stage.node().open(inputs(input_part({"front/scan", "scan"}, "front", queue)));
  for (int i = 0; i < 3; ++i) queue->push(front.next());
  stage.run();
  EXPECT_EQ(stage.status().received(), 3U);
  EXPECT_EQ(stage.status().published(), 0U);
  EXPECT_EQ(stage.status().lost(), 0U);
}

TEST(NodeInputs, AnObserverAccountsForEachPortApart) {
  Numbered<msg::Scan> front("front");
  Numbered<msg::Lines> lines("lines");
  const auto scan_queue = std::make_shared<MemoryQueue<msg::Scan>>();
  const auto line_queue = std::make_shared<MemoryQueue<msg::Lines>>();
  std::vector<std::string> ports;
  Stage stage({.service = "tape"}, always([&](Work& work) { ports.emplace_back(work.port()); }));
  stage.node().open(inputs(input_part({"front/scan", "scan"}, "front", scan_queue),
                           input_part({"walls/lines", "lines"}, "walls", line_queue)));
  for (int i = 0; i < 2; ++i) scan_queue->push(front.next());
  line_queue->push(lines.next());
  (void)lines.next();
  const msg::Lines last = lines.next();
  line_queue->push(last);
  line_queue->push(last);
  stage.run();
  EXPECT_THAT(ports, testing::UnorderedElementsAre("front/scan", "front/scan", "walls/lines",
                                                   "walls/lines"));
  const msg::ServiceStatus status = stage.status();
  ASSERT_EQ(status.inputs().size(), 2U);
  EXPECT_EQ(status.inputs()[0].received(), 2U);
  EXPECT_EQ(status.inputs()[0].lost(), 0U);
  EXPECT_EQ(status.inputs()[1].received(), 2U);
  EXPECT_EQ(status.inputs()[1].lost(), 1U);
  EXPECT_EQ(status.inputs()[1].duplicates(), 1U);
  EXPECT_EQ(status.received(), 4U);
}

TEST(NodeInputs, ABusyPortDoesNotStarveTheOther) {
  Numbered<msg::Scan> front("front");
  Numbered<msg::Scan> rear("rear");
  const auto busy = std::make_shared<MemoryQueue<msg::Scan>>();
  const auto calm = std::make_shared<MemoryQueue<msg::Scan>>();
  std::vector<std::string> ports;
  Stage stage({.service = "tape"}, always([&](Work& work) { ports.emplace_back(work.port()); }));
  stage.node().open(inputs(input_part({"front", "scan"}, "front", busy),
                           input_part({"rear", "scan"}, "rear", calm)));
  for (int i = 0; i < 100; ++i) busy->push(front.next());
  calm->push(rear.next());
  (void)stage.node().step();
  EXPECT_THAT(ports, ElementsAre("front", "rear"));
}

TEST(NodeInputs, NothingIsDueWhenNothingHasCome) {
  const auto queue = std::make_shared<MemoryQueue<msg::Scan>>();
  Stage stage({.service = "tape"}, nothing_to_do());
  stage.node().open(inputs(input_part({"scan", "scan"}, "front", queue)));
  EXPECT_FALSE(stage.node().step());
  EXPECT_EQ(stage.node().due(), std::nullopt);
  EXPECT_THAT(stage.losses(), IsEmpty());
}

}  // namespace
}  // namespace quoin::runtime
