// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/node/node.hpp"
#include "services/runtime/node/ports.hpp"
#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Stamps in ms of what a method got for a message; -1 where there was nothing.
struct Joined {
  std::int64_t stamp = 0;
  std::int64_t before = -1;
  std::int64_t after = -1;
  friend bool operator==(const Joined&, const Joined&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Joined& joined) {
    return out << joined.stamp << " in " << joined.before << ".." << joined.after;
  }
};

std::int64_t stamp_of(const msg::Lines* message) {
  return message == nullptr ? -1 : message->header().stamp() / millisecond;
}

/// A node that reads scans and, joined to them, lines.
class JoinTest : public testing::Test {
 protected:
  explicit JoinTest(Join join = Join::by_time) {
    stage_.emplace(Node::Settings{.service = "pose", .join_timeout = milliseconds(200)},
                   always([this, join](Work& work) {
                     const msg::Scan& scan = work.input<msg::Scan>();
                     Joined joined{scan.header().stamp() / millisecond};
                     if (join == Join::latest) {
                       joined.before = stamp_of(work.latest<msg::Lines>("odometry"));
                     } else {
                       const auto around = work.around<msg::Lines>("odometry");
                       joined.before = stamp_of(around.before);
                       joined.after = stamp_of(around.after);
                     }
                     joined_.push_back(joined);
                   }),
                   outputs(output_part(results_)));
    stage_->node().open(inputs(input_part({"scan", "scan"}, "front", scans_),
                               input_part({"odometry", "lines", join}, "wheels", odometry_)));
  }
  void scan(std::int64_t stamp) { scans_->push(front_.next_at(stamp * millisecond)); }
  void partner(std::int64_t stamp) { odometry_->push(wheels_.next_at(stamp * millisecond)); }
  std::uint64_t unjoined() { return stage_->status().inputs()[1].unjoined(); }
  std::string detail() { return stage_->status().detail(); }

  Numbered<msg::Scan> front_{"front"};
  Numbered<msg::Lines> wheels_{"wheels"};
  std::shared_ptr<MemoryQueue<msg::Scan>> scans_ = std::make_shared<MemoryQueue<msg::Scan>>();
  std::shared_ptr<MemoryQueue<msg::Lines>> odometry_ = std::make_shared<MemoryQueue<msg::Lines>>();
  std::shared_ptr<MemoryTopic<msg::Segments>> results_ =
      std::make_shared<MemoryTopic<msg::Segments>>();
  std::vector<Joined> joined_;
  std::optional<Stage> stage_;
};

TEST_F(JoinTest, GivesTheTwoMessagesAroundTheStamp) {
  for (const int stamp : {80, 90, 110, 120}) partner(stamp);
  scan(100);
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, 90, 110}));
  EXPECT_EQ(unjoined(), 0U);
}

TEST_F(JoinTest, AtAnEqualStampBothAreTheSameMessage) {
  for (const int stamp : {90, 100, 110}) partner(stamp);
  scan(100);
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, 100, 100}));
}

TEST_F(JoinTest, TheResultNamesWhatWasJoinedToIt) {
  for (const int stamp : {90, 110}) partner(stamp);
  scan(100);
  partner(200);
  scan(200);
  stage_->run();
  ASSERT_EQ(results_->written.size(), 2U);
  const auto& between = results_->written[0].header().origins();
  ASSERT_EQ(between.size(), 3U);
  EXPECT_EQ(between[0].source(), "front");
  EXPECT_EQ(between[1].source(), "wheels");
  EXPECT_EQ(between[1].sequence_number(), 0U);
  EXPECT_EQ(between[2].sequence_number(), 1U);
  const auto& equal = results_->written[1].header().origins();
  ASSERT_EQ(equal.size(), 2U) << "the same message is named once";
  EXPECT_EQ(equal[1].sequence_number(), 2U);
}

TEST_F(JoinTest, AMessageWaitsForALatePartner) {
  partner(90);
  scan(100);
  stage_->run();
  EXPECT_THAT(joined_, IsEmpty());
  EXPECT_EQ(stage_->node().due(), stage_->clock().now() + milliseconds(200));
  stage_->clock().advance(milliseconds(150));
  partner(95);
  stage_->run();
  EXPECT_THAT(joined_, IsEmpty()) << "one behind it may still come";
  partner(105);
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, 95, 105}));
  EXPECT_EQ(stage_->node().due(), std::nullopt);
  EXPECT_EQ(unjoined(), 0U);
  EXPECT_EQ(detail(), "");
}

TEST_F(JoinTest, GoesOnWithoutAPartnerThatDoesNotComeInTime) {
  partner(90);
  scan(100);
  stage_->run();
  stage_->clock().advance(milliseconds(199));
  stage_->run();
  EXPECT_THAT(joined_, IsEmpty());
  stage_->clock().advance(milliseconds(1));
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, 90, -1}));
  EXPECT_EQ(unjoined(), 1U);
  EXPECT_EQ(stage_->status().lost(), 0U) << "it gave a result";
}

TEST_F(JoinTest, SaysOnceThatAPartnerIsMissingAndTakesItBack) {
  const auto late = [this](std::int64_t stamp) {
    scan(stamp);
    stage_->run();
    stage_->clock().advance(milliseconds(200));
    stage_->run();
  };
  late(100);
  EXPECT_THAT(detail(), HasSubstr("port odometry from 'wheels'"));
  stage_->record().set_detail("something else");
  late(200);
  EXPECT_EQ(detail(), "something else") << "it has been said";
  EXPECT_EQ(unjoined(), 2U);
  stage_->record().set_detail("");
  late(300);
  partner(390);
  partner(410);
  scan(400);
  stage_->run();
  EXPECT_EQ(detail(), "");
  late(500);
  EXPECT_THAT(detail(), HasSubstr("port odometry from 'wheels'"));
  EXPECT_EQ(unjoined(), 4U);
  partner(600);
  scan(600);
  stage_->run();
  EXPECT_EQ(detail(), "");
  EXPECT_EQ(joined_.size(), 6U);
}

TEST_F(JoinTest, PartnersMayComeInAnyOrder) {
  for (const int stamp : {120, 90, 105, 95}) partner(stamp);
  scan(100);
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, 95, 105}));
}

TEST_F(JoinTest, APartnerAheadIsKeptForWhatComes) {
  for (int stamp = 0; stamp <= 500; stamp += 50) partner(stamp);
  for (const int stamp : {110, 220, 330}) scan(stamp);
  stage_->run();
  EXPECT_THAT(joined_,
              ElementsAre(Joined{110, 100, 150}, Joined{220, 200, 250}, Joined{330, 300, 350}));
}

TEST_F(JoinTest, TheOrderOfMessagesIsKept) {
  for (const int stamp : {100, 200, 300}) scan(stamp);
  partner(90);
  partner(250);
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, 90, 250}, Joined{200, 90, 250}));
  partner(350);
  stage_->run();
  ASSERT_EQ(joined_.size(), 3U);
  EXPECT_EQ(joined_[2], (Joined{300, 250, 350}));
  EXPECT_THAT(numbers(results_->written), ElementsAre(0, 1, 2));
}

TEST_F(JoinTest, ADrainedNodeDoesNotWait) {
  partner(90);
  for (const int stamp : {100, 200}) scan(stamp);
  stage_->run();
  EXPECT_THAT(joined_, IsEmpty());
  stage_->node().drain();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, 90, -1}, Joined{200, 90, -1}));
  EXPECT_EQ(unjoined(), 2U);
}

TEST_F(JoinTest, ANodeThatIsToStopDoesNotWait) {
  scan(100);
  stage_->run();
  stage_->request_stop();
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, -1, -1}));
}

TEST_F(JoinTest, WhatWaitsIsBoundedAndTheRestStaysWithTheInput) {
  for (int i = 0; i < 300; ++i) scan(100 + i);
  stage_->run();
  EXPECT_EQ(scans_->size(), 300U - 256U);
  partner(1000);
  stage_->run();
  EXPECT_EQ(joined_.size(), 300U);
}

TEST_F(JoinTest, LossesOfAPartnerAreItsPortsAlone) {
  partner(90);
  (void)wheels_.next_at(0);
  partner(110);
  scan(100);
  stage_->run();
  const msg::ServiceStatus status = stage_->status();
  EXPECT_EQ(status.inputs()[1].received(), 2U);
  EXPECT_EQ(status.inputs()[1].lost(), 1U);
  EXPECT_EQ(status.received(), 1U);
  EXPECT_EQ(status.lost(), 0U);
}

class LatestTest : public JoinTest {
 protected:
  LatestTest() : JoinTest(Join::latest) {}
};

TEST_F(LatestTest, GivesTheNewestAndNeverWaits) {
  scan(100);
  stage_->run();
  EXPECT_THAT(joined_, ElementsAre(Joined{100, -1, -1}));
  partner(150);
  partner(120);
  scan(200);
  scan(300);
  stage_->run();
  EXPECT_THAT(joined_,
              ElementsAre(Joined{100, -1, -1}, Joined{200, 150, -1}, Joined{300, 150, -1}));
  EXPECT_EQ(unjoined(), 1U);
}

TEST(Joins, ThePortsThatAreMissedAreAllNamed) {
  Numbered<msg::Scan> front("front");
  Numbered<msg::Lines> wheels("wheels");
  const auto scans = std::make_shared<MemoryQueue<msg::Scan>>();
  const auto odometry = std::make_shared<MemoryQueue<msg::Lines>>();
  const auto map = std::make_shared<MemoryQueue<msg::Corners>>();
  Stage stage({.service = "pose"}, nothing_to_do());
  stage.node().open(inputs(input_part({"scan", "scan"}, "front", scans),
                           input_part({"odometry", "lines", Join::latest}, "wheels", odometry),
                           input_part({"map", "corners", Join::latest}, "mapping", map)));
  scans->push(front.next());
  stage.run();
  EXPECT_THAT(stage.status().detail(),
              testing::AllOf(HasSubstr("'wheels'"), HasSubstr("'mapping'")));
  odometry->push(wheels.next());
  scans->push(front.next());
  stage.run();
  EXPECT_THAT(stage.status().detail(),
              testing::AllOf(testing::Not(HasSubstr("'wheels'")), HasSubstr("'mapping'")));
}

TEST(Joins, GiveAMethodAllMessagesUpToTheStampThatItWants) {
  Numbered<msg::Scan> front("front");
  Numbered<msg::Lines> wheels("wheels");
  const auto scans = std::make_shared<MemoryQueue<msg::Scan>>();
  const auto odometry = std::make_shared<MemoryQueue<msg::Lines>>();
  std::vector<std::int64_t> stamps;
  const auto make = [&](const std::string&, const ParameterSettings&) {
    const auto until = [](const Message& message) {
      return message.header->stamp() + 50 * millisecond;
    };
    return Method{.handle =
                      [&stamps, until](Work& work) {
                        for (const msg::Lines* each :
                             work.through<msg::Lines>("odometry", until(work.message()))) {
                          stamps.push_back(stamp_of(each));
                        }
                      },
                  .last_stamp = until};
  };
  Stage stage({.service = "deskewing", .join_timeout = milliseconds(200)}, make);
  stage.node().open(inputs(input_part({"scan", "scan"}, "front", scans),
                           input_part({"odometry", "lines", Join::by_time}, "wheels", odometry)));
  for (const int stamp : {80, 95, 110, 130}) odometry->push(wheels.next_at(stamp * millisecond));
  scans->push(front.next_at(100 * millisecond));
  stage.run();
  EXPECT_THAT(stamps, IsEmpty()) << "not yet up to 150";
  for (const int stamp : {155, 170}) odometry->push(wheels.next_at(stamp * millisecond));
  stage.run();
  EXPECT_THAT(stamps, ElementsAre(95, 110, 130, 155));
  EXPECT_EQ(stage.status().inputs()[1].unjoined(), 0U);
  // Nothing more comes in time.
  stamps.clear();
  scans->push(front.next_at(160 * millisecond));
  stage.run();
  stage.clock().advance(milliseconds(250));
  stage.run();
  EXPECT_THAT(stamps, ElementsAre(155, 170));
  EXPECT_EQ(stage.status().inputs()[1].unjoined(), 1U);
}

TEST(Joins, AnOptionalPortThatIsNotWiredGivesNothing) {
  Numbered<msg::Scan> front("front");
  const auto scans = std::make_shared<MemoryQueue<msg::Scan>>();
  Stage stage({.service = "pose"}, always([](Work& work) {
                EXPECT_EQ(work.latest<msg::Corners>("map"), nullptr);
                EXPECT_EQ(work.around<msg::Lines>("odometry").before, nullptr);
                EXPECT_EQ(work.around<msg::Lines>("odometry").after, nullptr);
              }));
  stage.node().open(inputs(input_part({"scan", "scan"}, "front", scans)));
  scans->push(front.next());
  stage.run();
  EXPECT_EQ(stage.status().received(), 1U);
  EXPECT_EQ(stage.status().lost(), 0U);
}

TEST_F(LatestTest, KeepsNoOtherThanTheNewest) {
  for (int i = 0; i < 100; ++i) partner(20 + i);
  stage_->run();
  scan(1000);
  stage_->run();
  EXPECT_EQ(joined_.back().before, 119);
  EXPECT_EQ(odometry_->kept(), 1U);
}

/// Of a stamp in ms.
Message partner_message(std::int64_t stamp, std::uint64_t number = 0) {
  const auto lines = std::make_shared<msg::Lines>();
  topics::set_origin(lines->header(), "wheels", 1, number);
  lines->header().stamp(stamp * millisecond);
  return {lines, &typeid(msg::Lines), &lines->header()};
}

std::int64_t stamp_of(const Message* message) {
  return message == nullptr ? -1 : message->header->stamp() / millisecond;
}

TEST(Partners, AreFoundByTheirStamps) {
  Partners partners;
  EXPECT_EQ(partners.latest(), nullptr);
  EXPECT_EQ(partners.before(0), nullptr);
  EXPECT_EQ(partners.after(0), nullptr);
  for (const int stamp : {30, 10, 20}) partners.add(partner_message(stamp));
  EXPECT_EQ(stamp_of(partners.latest()), 30);
  EXPECT_EQ(stamp_of(partners.before(25 * millisecond)), 20);
  EXPECT_EQ(stamp_of(partners.after(25 * millisecond)), 30);
  EXPECT_EQ(stamp_of(partners.before(20 * millisecond)), 20);
  EXPECT_EQ(stamp_of(partners.after(20 * millisecond)), 20);
  EXPECT_EQ(stamp_of(partners.before(9 * millisecond)), -1);
  EXPECT_EQ(stamp_of(partners.after(31 * millisecond)), -1);
}

TEST(Partners, OfOneStampTheOneThatCameLastCounts) {
  Partners partners;
  partners.add(partner_message(10, 1));
  partners.add(partner_message(10, 2));
  EXPECT_EQ(partners.size(), 1U);
  EXPECT_EQ(topics::sequence_number(*partners.latest()->header), 2U);
}

TEST(Partners, TheNearestOlderOneIsNotForgotten) {
  Partners partners;
  for (const int stamp : {10, 20, 30, 40}) partners.add(partner_message(stamp));
  partners.forget_before(35 * millisecond);
  EXPECT_EQ(partners.size(), 2U);
  EXPECT_EQ(stamp_of(partners.before(35 * millisecond)), 30);
  partners.forget_before(100 * millisecond);
  EXPECT_EQ(partners.size(), 1U);
  EXPECT_EQ(stamp_of(partners.latest()), 40);
}

TEST(Partners, AreBoundedWhileNobodyAsks) {
  Partners partners;
  for (int stamp = 0; stamp < 5000; ++stamp) partners.add(partner_message(stamp));
  EXPECT_EQ(partners.size(), 2048U);
  EXPECT_EQ(stamp_of(partners.latest()), 4999);
  EXPECT_EQ(stamp_of(partners.before(0)), -1) << "the oldest go first";
}

}  // namespace
}  // namespace quoin::runtime
