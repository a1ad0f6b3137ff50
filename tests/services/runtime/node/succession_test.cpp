// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/succession.hpp"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/services/runtime/node/requests.hpp"
#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

std::vector<std::uint64_t> up_to(std::uint64_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// One process of the service that reads scans.
struct Walls {
  Walls(MemoryTopic<msg::Scan>& scans, const std::shared_ptr<MemoryTopic<msg::Segments>>& results,
        bool held, MethodFactory make)
      : queue(scans.subscribe()),
        stage({.service = "walls", .held = held, .longest_handover = milliseconds(200)},
              std::move(make), outputs(output_part(results))) {
    stage.node().open(inputs(input_part({"scan", "scan"}, "front", queue)));
  }

  std::shared_ptr<MemoryQueue<msg::Scan>> queue;
  Stage stage;
};

/// A source whose scans go to all processes of a service, which write to one topic.
class SuccessionTest : public testing::Test {
 protected:
  std::unique_ptr<Walls> start(bool held, MethodFactory make = nothing_to_do()) {
    return std::make_unique<Walls>(scans_, results_, held, std::move(make));
  }
  void publish(int count) {
    for (int i = 0; i < count; ++i) scans_.publish(front_.next());
  }
  /// Results in the order of their scans, each once.
  void expect_all() {
    EXPECT_THAT(numbers(results_->written), ElementsAreArray(up_to(front_.published())));
    ScanAccounting accounting;
    for (const msg::Segments& segments : results_->written) accounting.receive(segments.header());
    EXPECT_EQ(accounting.received(), front_.published());
    EXPECT_EQ(accounting.lost(), 0U);
    EXPECT_EQ(accounting.duplicates(), 0U);
  }

  Numbered<msg::Scan> front_{"front"};
  MemoryTopic<msg::Scan> scans_;
  std::shared_ptr<MemoryTopic<msg::Segments>> results_ =
      std::make_shared<MemoryTopic<msg::Segments>>();
};

TEST_F(SuccessionTest, AHeldProcessReadsAndPublishesNothing) {
  const auto successor = start(true);
  publish(5);
  successor->stage.run();
  EXPECT_EQ(successor->queue->size(), 0U);
  EXPECT_THAT(results_->written, IsEmpty());
  EXPECT_TRUE(successor->stage.node().succession().held());
}

TEST_F(SuccessionTest, AskedToHoldItKeepsTheNewestAndAllThatFollow) {
  const auto successor = start(true);
  publish(5);
  successor->stage.run();
  msg::ControlReply reply = hold(successor->stage);
  EXPECT_EQ(reply.held_scans(), 1U);
  EXPECT_THAT(positions_of(reply), ElementsAre(Pair("scan", 4)));
  EXPECT_EQ(reply.first_sequence_number(), 4U);
  publish(3);
  successor->stage.run();
  reply = hold(successor->stage);
  EXPECT_EQ(reply.held_scans(), 4U);
  EXPECT_THAT(positions_of(reply), ElementsAre(Pair("scan", 4)));
}

TEST_F(SuccessionTest, AskedToHoldBeforeAnythingCameItKeepsAllThatComes) {
  const auto successor = start(true);
  EXPECT_THAT(positions_of(hold(successor->stage)), IsEmpty());
  publish(3);
  successor->stage.run();
  EXPECT_EQ(hold(successor->stage).held_scans(), 3U);
  EXPECT_THAT(positions_of(hold(successor->stage)), ElementsAre(Pair("scan", 0)));
}

TEST_F(SuccessionTest, NoneIsLostAndNoneDoubledWhereverThePredecessorStands) {
  for (int ahead = 0; ahead <= 6; ++ahead) {
    SCOPED_TRACE(ahead);
    front_ = Numbered<msg::Scan>("front");
    scans_ = {};
    results_->written.clear();
    const auto predecessor = start(false);
    publish(3);
    predecessor->stage.run();
    const auto successor = start(true);
    publish(2);
    successor->stage.run();
    const Positions from = positions_of(hold(successor->stage));
    publish(4);
    for (int i = 0; i < ahead; ++i) (void)predecessor->stage.node().step();
    const msg::ControlReply left = hand_over(predecessor->stage, from);
    EXPECT_TRUE(predecessor->stage.node().has_left());
    publish(2);
    (void)take_over(successor->stage, positions_of(left), left.state());
    successor->stage.run();
    EXPECT_FALSE(successor->stage.node().succession().held());
    EXPECT_EQ(successor->stage.status().state(), msg::ServiceState::STATE_ACTIVE);
    publish(2);
    predecessor->stage.run();
    successor->stage.run();
    expect_all();
    EXPECT_EQ(positions_of(left).at("scan"),
              std::max<std::uint64_t>(4, 3 + static_cast<std::uint64_t>(ahead)));
    EXPECT_EQ(successor->stage.status().lost(), 0U);
  }
}

TEST_F(SuccessionTest, ThePredecessorWaitsForTheScansThatItIsToHandle) {
  const auto predecessor = start(false);
  const auto successor = start(true);
  publish(2);
  predecessor->stage.run();
  const msg::Scan late = front_.next();  // has not come to the predecessor yet
  successor->queue->push(late);
  const msg::Scan later = front_.next();
  successor->queue->push(later);
  successor->stage.run();
  const Positions from = positions_of(hold(successor->stage));
  ASSERT_THAT(from, ElementsAre(Pair("scan", 3)));
  bool came = false;
  const msg::ControlReply left =
      answer(predecessor->stage, request_to(msg::ControlAction::CONTROL_HAND_OVER, from), [&] {
        predecessor->stage.run();
        if (predecessor->stage.node().has_left()) {
          predecessor->stage.node().leave();
        } else if (predecessor->stage.node().succession().asked() && !std::exchange(came, true)) {
          EXPECT_EQ(results_->written.size(), 2U);
          predecessor->queue->push(late);
          predecessor->queue->push(later);
        }
      });
  EXPECT_THAT(positions_of(left), ElementsAre(Pair("scan", 3)));
  (void)take_over(successor->stage, positions_of(left));
  successor->stage.run();
  expect_all();
}

TEST_F(SuccessionTest, MessagesThatThePredecessorHandledMayComeLate) {
  const auto predecessor = start(false);
  const auto successor = start(true);
  scans_.arrivals = [](std::size_t reader) { return reader == 0 ? 1 : 0; };
  publish(4);
  predecessor->stage.run();
  const msg::ControlReply left =
      hand_over(predecessor->stage, positions_of(hold(successor->stage)));
  (void)take_over(successor->stage, positions_of(left));
  for (msg::Segments& segments : results_->written) {
    msg::Scan scan;
    scan.header() = segments.header();
    scan.header().trace().resize(1);
    successor->queue->push(scan);
  }
  scans_.arrivals = [](std::size_t) { return 1; };
  publish(2);
  successor->stage.run();
  expect_all();
  EXPECT_EQ(successor->stage.status().received(), 2U);
}

TEST_F(SuccessionTest, APredecessorThatIsToLeaveEverythingHandlesNothingMore) {
  const auto predecessor = start(false);
  publish(2);
  predecessor->stage.run();
  const auto successor = start(true);
  publish(3);
  successor->stage.run();
  (void)hold(successor->stage);
  const msg::ControlReply left = hand_over(predecessor->stage, {});
  EXPECT_TRUE(predecessor->stage.node().has_left());
  EXPECT_THAT(positions_of(left), ElementsAre(Pair("scan", 2)));
  EXPECT_THAT(numbers(results_->written), ElementsAre(0, 1));
}

TEST_F(SuccessionTest, WithoutPositionsTheSuccessorBeginsWithWhatItHolds) {
  const auto successor = start(true);
  publish(5);
  successor->stage.run();
  (void)hold(successor->stage);
  publish(2);
  successor->stage.run();
  (void)take_over(successor->stage, {});
  successor->stage.run();
  publish(1);
  successor->stage.run();
  EXPECT_THAT(numbers(results_->written), ElementsAre(4, 5, 6, 7));
}

TEST_F(SuccessionTest, MayFollowOneAnotherWithoutAScanInBetween) {
  const auto first = start(false);
  publish(3);
  first->stage.run();
  const auto second = start(true);
  const auto third = start(true);
  publish(2);
  second->stage.run();
  third->stage.run();
  const Positions held_by_second = positions_of(hold(second->stage));
  const Positions held_by_third = positions_of(hold(third->stage));
  first->stage.run();  // all five
  const msg::ControlReply left_by_first = hand_over(first->stage, held_by_second);
  (void)take_over(second->stage, positions_of(left_by_first));
  second->stage.run();
  const msg::ControlReply left_by_second = hand_over(second->stage, held_by_third);
  EXPECT_THAT(positions_of(left_by_second), ElementsAre(Pair("scan", 5)));
  (void)take_over(third->stage, positions_of(left_by_second));
  publish(2);
  third->stage.run();
  expect_all();
}

TEST_F(SuccessionTest, ARestartOfTheSourceBeforeTheFirstScanIsFollowed) {
  const auto predecessor = start(false);
  const auto successor = start(true);
  publish(10);
  predecessor->stage.run();
  successor->stage.run();
  const msg::ControlReply left =
      hand_over(predecessor->stage, positions_of(hold(successor->stage)));
  (void)take_over(successor->stage, positions_of(left));
  front_.restart();
  publish(3);
  successor->stage.run();
  EXPECT_EQ(results_->written.size(), 13U);
}

TEST_F(SuccessionTest, AHandOverThatIsNotDoneInTimeIsRefusedAndTheWorkGoesOn) {
  const auto predecessor = start(false);
  publish(3);
  predecessor->stage.run();
  EXPECT_THROW((void)hand_over(predecessor->stage, {{"scan", 100}}), std::runtime_error);
  publish(3);
  predecessor->stage.run();
  EXPECT_FALSE(predecessor->stage.node().has_left());
  expect_all();
}

TEST_F(SuccessionTest, RequestsThatDoNotFitAreRefused) {
  const auto active = start(false);
  const auto held = start(true);
  EXPECT_THROW((void)hold(active->stage), std::runtime_error);
  EXPECT_THROW((void)take_over(active->stage, {}), std::runtime_error);
  EXPECT_THROW((void)answer(held->stage, request_to(msg::ControlAction::CONTROL_HAND_OVER)),
               std::runtime_error);
  msg::ControlReply reply;
  EXPECT_FALSE(active->stage.node().succession().handle(
      request_to(msg::ControlAction::CONTROL_DESCRIBE), reply));
}

/// A method that numbers what it has handled, over all processes.
MethodFactory counting(std::string form = "count/1") {
  return [form](const std::string&, const ParameterSettings&) {
    const auto count = std::make_shared<std::uint8_t>(0);
    return Method{
        .handle = [count](Work& work) { work.output<msg::Segments>().scan_points((*count)++); },
        .state_form = form,
        .save =
            [count] {
              return State{1, *count};
            },
        .restore =
            [count](const State& state) {
              if (state.size() != 2 || state[0] != 1) throw std::invalid_argument("no count");
              *count = state[1];
            }};
  };
}

TEST_F(SuccessionTest, TheStateOfTheMethodGoesOver) {
  const auto predecessor = start(false, counting());
  const auto successor = start(true, counting());
  publish(4);
  predecessor->stage.run();
  successor->stage.run();
  const Positions from = positions_of(hold(successor->stage));
  publish(2);
  const msg::ControlReply left = hand_over(predecessor->stage, from);
  (void)take_over(successor->stage, positions_of(left), left.state());
  publish(2);
  successor->stage.run();
  expect_all();
  for (std::size_t i = 0; i < results_->written.size(); ++i) {
    EXPECT_EQ(results_->written[i].scan_points(), i);
  }
}

TEST_F(SuccessionTest, WithAStateThatItCannotUseTheSuccessorBeginsAnew) {
  const auto successor = start(true, counting());
  publish(1);
  successor->stage.run();
  (void)hold(successor->stage);
  (void)take_over(successor->stage, {{"scan", 0}}, {9, 9, 9});
  successor->stage.run();
  EXPECT_EQ(results_->written.at(0).scan_points(), 0U);
}

/// A process of an observer with two ports.
struct Tape {
  using Handled = std::vector<std::pair<std::string, std::uint64_t>>;
  Tape(MemoryTopic<msg::Scan>& scan_topic, MemoryTopic<msg::Lines>& line_topic, bool held,
       Handled& handled)
      : scans(scan_topic.subscribe()),
        lines(line_topic.subscribe()),
        stage({.service = "tape", .held = held, .longest_handover = milliseconds(200)},
              always([&handled](Work& work) {
                handled.emplace_back(work.port(), topics::sequence_number(*work.message().header));
              })) {
    stage.node().open(inputs(input_part({"scan", "scan"}, "front", scans),
                             input_part({"lines", "lines"}, "wctls", lines)));
  }

  std::shared_ptr<MemoryQueue<msg::Scan>> scans;
  std::shared_ptr<MemoryQueue<msg::Lines>> lines;
  Stage stage;
};

class TwoPortSuccession : public testing::Test {
 protected:
  std::unique_ptr<Tape> start(bool held) {
    return std::make_unique<Tape>(scans_, lines_, held, handled_);
  }
  void publish(int scans, int lines) {
    for (int i = 0; i < scans; ++i) scans_.publish(front_.next());
    for (int i = 0; i < lines; ++i) lines_.publish(wctls_.next());
  }
  std::vector<std::uint64_t> handled(const std::string& port) const {
    std::vector<std::uint64_t> numbers;
    for (const auto& [by, number] : handled_) {
      if (by == port) numbers.push_back(number);
    }
    return numbers;
  }
  void expect_all() {
    EXPECT_THAT(handled("scan"), ElementsAreArray(up_to(front_.published())));
    EXPECT_THAT(handled("lines"), ElementsAreArray(up_to(wctls_.published())));
  }

  Numbered<msg::Scan> front_{"front"};
  Numbered<msg::Lines> wctls_{"wctls"};
  MemoryTopic<msg::Scan> scans_;
  MemoryTopic<msg::Lines> lines_;
  Tape::Handled handled_;
};

TEST_F(TwoPortSuccession, EachPortHasItsOwnPosition) {
  const auto predecessor = start(false);
  const auto successor = start(true);
  publish(5, 2);
  successor->stage.run();
  const Positions from = positions_of(hold(successor->stage));
  EXPECT_THAT(from, ElementsAre(Pair("lines", 1), Pair("scan", 4)));
  publish(1, 4);
  successor->stage.run();
  EXPECT_EQ(hold(successor->stage).held_scans(), 7U);
  const msg::ControlReply left = hand_over(predecessor->stage, from);
  (void)take_over(successor->stage, positions_of(left));
  publish(2, 2);
  successor->stage.run();
  expect_all();
}

TEST_F(TwoPortSuccession, ThePredecessorGoesOnWithThePortThatIsNotThereYet) {
  const auto predecessor = start(false);
  const auto successor = start(true);
  publish(3, 0);
  predecessor->stage.run();
  const msg::Lines late = wctls_.next();
  const msg::Lines held = wctls_.next();
  successor->lines->push(late);
  successor->lines->push(held);
  successor->stage.run();
  const Positions from = positions_of(hold(successor->stage));
  bool came = false;
  const msg::ControlReply left =
      answer(predecessor->stage, request_to(msg::ControlAction::CONTROL_HAND_OVER, from), [&] {
        predecessor->stage.run();
        if (predecessor->stage.node().has_left()) {
          predecessor->stage.node().leave();
        } else if (predecessor->stage.node().succession().asked() && !std::exchange(came, true)) {
          publish(1, 0);  // for the successor
          predecessor->lines->push(late);
          predecessor->lines->push(held);
        }
      });
  (void)take_over(successor->stage, positions_of(left));
  successor->stage.run();
  expect_all();
}

TEST_F(TwoPortSuccession, APortOnWhichNothingCameIsLeftAtOnce) {
  const auto predecessor = start(false);
  const auto successor = start(true);
  publish(3, 0);
  successor->stage.run();
  const Positions from = positions_of(hold(successor->stage));
  EXPECT_THAT(from, ElementsAre(Pair("scan", 2)));
  publish(0, 3);
  const msg::ControlReply left = hand_over(predecessor->stage, from);
  (void)take_over(successor->stage, positions_of(left));
  successor->stage.run();
  expect_all();
}

TEST_F(TwoPortSuccession, AfterARefusedHandOverBothPortsGoOn) {
  const auto predecessor = start(false);
  publish(3, 3);
  predecessor->stage.run();
  bool came = false;
  EXPECT_THROW(
      (void)answer(predecessor->stage,
                   request_to(msg::ControlAction::CONTROL_HAND_OVER, {{"scan", 3}, {"lines", 100}}),
                   [&] {
                     predecessor->stage.run();
                     if (!predecessor->stage.node().succession().asked()) return;
                     if (!std::exchange(came, true)) publish(2, 2);
                   }),
      std::runtime_error);
  ASSERT_TRUE(came);
  publish(2, 2);
  predecessor->stage.run();
  EXPECT_FALSE(predecessor->stage.node().has_left());
  expect_all();
}

TEST(SuccessionRequests, WakeTheOtherThreadEvenWhenItBeginsToListenLater) {
  Succession successor(true);
  msg::ControlReply reply;
  ASSERT_TRUE(successor.handle(request_to(msg::ControlAction::CONTROL_TAKE_OVER), reply));
  int woken = 0;
  successor.on_request([&] { ++woken; });
  EXPECT_EQ(woken, 1);
  successor.on_request(nullptr);
  ASSERT_TRUE(successor.begin().has_value());
  EXPECT_FALSE(successor.held());
  EXPECT_EQ(woken, 1);
}

TEST(SuccessionRequests, TheReplyNamesTheFirstScanOfASource) {
  Succession source(false);
  msg::ControlReply reply;
  auto asked = std::async(std::launch::async, [&] {
    return source.handle(request_to(msg::ControlAction::CONTROL_HAND_OVER), reply);
  });
  while (!source.asked()) std::this_thread::yield();
  EXPECT_TRUE(source.leaves("", 0));
  source.left({{"", 42}}, {1, 2});
  ASSERT_TRUE(asked.get());
  EXPECT_THAT(positions_of(reply), ElementsAre(Pair("", 42)));
  EXPECT_EQ(reply.first_sequence_number(), 42U);
  EXPECT_THAT(reply.state(), ElementsAre(1, 2));
}

TEST(SuccessionRequests, ARefusalSaysWhatWasWaitedFor) {
  Succession predecessor(false, milliseconds(0));
  msg::ControlReply reply;
  try {
    (void)predecessor.handle(request_to(msg::ControlAction::CONTROL_HAND_OVER, {{"scan", 7}}),
                             reply);
    FAIL() << "nobody has left";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("scan 7"));
  }
  EXPECT_FALSE(predecessor.asked());
}

}  // namespace
}  // namespace quoin::runtime
