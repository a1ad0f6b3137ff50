// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/accounting/accounting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/topics/header.hpp"

namespace quoin::runtime {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;

/// A pipeline whose stages can be told to drop or restart; makes the headers that reach its end.
class Pipeline {
 public:
  Pipeline() : stages_{{"front", 1, 0}, {"walls", 1, 0}, {"wctls", 1, 0}} {}

  /// The next scan, lost behind stage `delivered_by` - 1; arrives when no stage loses it.
  msg::Header scan(std::size_t passed_stages = 3) {
    msg::Header header;
    topics::set_origin(header, "front", stages_[0].incarnation, next_++);
    for (std::size_t i = 0; i < std::min<std::size_t>(passed_stages, stages_.size()); ++i) {
      msg::StageTrace trace;
      trace.service(stages_[i].name);
      trace.incarnation(stages_[i].incarnation);
      trace.index(stages_[i].index++);
      header.trace().push_back(trace);
    }
    return header;
  }

  void restart(std::size_t stage) {
    take_over(stage);
    if (stage == 0) next_ = 0;
  }

  /// Another process goes on where the present one of that stage ends.
  void take_over(std::size_t stage) {
    ++stages_[stage].incarnation;
    stages_[stage].index = 0;
  }

  /// The scans come by way of another service, which has published `index` results already.
  void rewire(std::size_t stage, const std::string& name, std::uint64_t index) {
    stages_[stage] = {name, 1, index};
  }

 private:
  struct StageState {
    std::string name;
    std::uint64_t incarnation;
    std::uint64_t index;
  };
  std::vector<StageState> stages_;
  std::uint64_t next_ = 0;
};

TEST(ScanAccounting, CountsNothingWhenAllArrive) {
  Pipeline pipeline;
  ScanAccounting accounting;
  for (int i = 0; i < 10; ++i) EXPECT_THAT(accounting.receive(pipeline.scan()), IsEmpty());
  EXPECT_EQ(accounting.received(), 10U);
  EXPECT_EQ(accounting.lost(), 0U);
  EXPECT_EQ(accounting.first_sequence(), 0U);
}

TEST(ScanAccounting, ScansBeforeTheFirstMessageAreNotLost) {
  Pipeline pipeline;
  ScanAccounting accounting;
  for (int i = 0; i < 7; ++i) (void)pipeline.scan();
  accounting.receive(pipeline.scan());
  EXPECT_EQ(accounting.lost(), 0U);
  EXPECT_EQ(accounting.first_sequence(), 7U);
}

TEST(ScanAccounting, NamesTheStageThatDidNotDeliver) {
  Pipeline pipeline;
  ScanAccounting accounting;
  accounting.receive(pipeline.scan());
  (void)pipeline.scan(1);  // never became segments
  (void)pipeline.scan(2);  // never became lines
  (void)pipeline.scan(2);
  (void)pipeline.scan(3);  // published, did not arrive
  const auto losses = accounting.receive(pipeline.scan());
  ASSERT_EQ(losses.size(), 3U);
  for (const Loss& loss : losses) {
    EXPECT_EQ(loss.first_sequence, 1U);
    EXPECT_EQ(loss.last_sequence, 4U);
  }
  EXPECT_THAT(accounting.lost_by_site(),
              UnorderedElementsAre(Pair(LossSite{LossPlace::service, "walls"}, 1),
                                   Pair(LossSite{LossPlace::service, "wctls"}, 2),
                                   Pair(LossSite{LossPlace::link}, 1)));
  EXPECT_EQ(accounting.lost(), 4U);
}

TEST(ScanAccounting, ScansTheSourceCouldNotWriteAreItsOwnLoss) {
  Pipeline pipeline;
  ScanAccounting accounting;
  accounting.receive(pipeline.scan());
  (void)pipeline.scan(0);
  accounting.receive(pipeline.scan());
  EXPECT_THAT(accounting.lost_by_site(),
              ElementsAre(Pair(LossSite{LossPlace::service, "front"}, 1)));
}

TEST(ScanAccounting, ARestartedStageAnswersForTheScansInBetween) {
  Pipeline pipeline;
  ScanAccounting accounting;
  accounting.receive(pipeline.scan());
  for (int i = 0; i < 5; ++i) (void)pipeline.scan(1);
  pipeline.restart(1);
  accounting.receive(pipeline.scan());
  EXPECT_THAT(accounting.lost_by_site(),
              ElementsAre(Pair(LossSite{LossPlace::service, "walls"}, 5)));
}

TEST(ScanAccounting, WhatALaterStageMadeTheRestartedOneMustHaveMadeToo) {
  Pipeline pipeline;
  ScanAccounting accounting;
  accounting.receive(pipeline.scan());
  (void)pipeline.scan(3);  // passed by walls before its restart, lost on the last link
  (void)pipeline.scan(1);
  pipeline.restart(1);
  accounting.receive(pipeline.scan());
  EXPECT_THAT(accounting.lost_by_site(),
              UnorderedElementsAre(Pair(LossSite{LossPlace::service, "walls"}, 1),
                                   Pair(LossSite{LossPlace::link}, 1)));
}

TEST(ScanAccounting, ARestartedSourceStartsAnew) {
  Pipeline pipeline;
  ScanAccounting accounting;
  for (int i = 0; i < 20; ++i) accounting.receive(pipeline.scan());
  pipeline.restart(0);
  (void)pipeline.scan(1);
  const auto losses = accounting.receive(pipeline.scan());
  ASSERT_EQ(losses.size(), 1U);
  EXPECT_EQ(losses[0].site, (LossSite{LossPlace::service, "walls"}));
  EXPECT_EQ(losses[0].first_sequence, 0U);
  EXPECT_EQ(losses[0].last_sequence, 0U);
  EXPECT_EQ(accounting.received(), 21U);
}

TEST(ScanAccounting, AProcessThatTakesOverLosesNothing) {
  for (std::size_t stage = 0; stage < 3; ++stage) {
    SCOPED_TRACE(stage);
    Pipeline pipeline;
    ScanAccounting accounting;
    for (int i = 0; i < 20; ++i) accounting.receive(pipeline.scan());
    pipeline.take_over(stage);
    for (int i = 0; i < 20; ++i) EXPECT_THAT(accounting.receive(pipeline.scan()), IsEmpty());
    EXPECT_EQ(accounting.received(), 40U);
    EXPECT_EQ(accounting.duplicates(), 0U);
  }
}

TEST(ScanAccounting, WhatIsMissingAroundATakeOverIsCounted) {
  Pipeline pipeline;
  ScanAccounting accounting;
  for (int i = 0; i < 20; ++i) accounting.receive(pipeline.scan());
  (void)pipeline.scan();
  pipeline.take_over(0);
  (void)pipeline.scan();
  accounting.receive(pipeline.scan());
  EXPECT_EQ(accounting.lost(), 2U);
}

TEST(ScanAccounting, AnInputThatIsRewiredLosesNothing) {
  Pipeline pipeline;
  ScanAccounting accounting;
  for (int i = 0; i < 20; ++i) accounting.receive(pipeline.scan());
  pipeline.rewire(1, "more_walls", 500);
  pipeline.take_over(2);
  EXPECT_THAT(accounting.receive(pipeline.scan()), IsEmpty());
  (void)pipeline.scan(2);
  accounting.receive(pipeline.scan());
  EXPECT_THAT(accounting.lost_by_site(),
              ElementsAre(Pair(LossSite{LossPlace::service, "wctls"}, 1)));
}

TEST(ScanAccounting, AnotherSensorBeginsAnew) {
  Pipeline pipeline;
  ScanAccounting accounting;
  for (int i = 0; i < 20; ++i) accounting.receive(pipeline.scan());
  msg::Header other = pipeline.scan();
  topics::set_origin(other, "rear", 1, 7);
  EXPECT_THAT(accounting.receive(other), IsEmpty());
  EXPECT_EQ(accounting.received(), 21U);
}

TEST(ScanAccounting, NothingIsLostWhileNobodyListens) {
  Pipeline pipeline;
  ScanAccounting accounting;
  accounting.receive(pipeline.scan());
  accounting.interrupt();
  for (int i = 0; i < 5; ++i) (void)pipeline.scan();
  EXPECT_THAT(accounting.receive(pipeline.scan()), IsEmpty());
}

/// A header of a chain whose middle stage has two instances; all times in steps of a scan.
msg::Header by_instance(std::uint64_t scan, std::uint64_t started, std::uint64_t index) {
  msg::Header header;
  topics::set_origin(header, "front", 1, scan);
  header.trace().resize(3);
  const char* const names[] = {"front", "walls", "wctls"};
  for (std::size_t i = 0; i < 3; ++i) {
    header.trace()[i].service(names[i]);
    header.trace()[i].incarnation(1);
    header.trace()[i].published(static_cast<std::int64_t>(1000 + scan));
  }
  header.trace()[0].index(scan);
  header.trace()[1].incarnation(started);
  header.trace()[1].index(index);
  header.trace()[2].index(scan);
  return header;
}

TEST(ScanAccounting, AStandbyThatTakesOverAnswersForTheGapAndNoMore) {
  ScanAccounting accounting;
  accounting.receive(by_instance(100, 1, 100));
  // The other instance lived all the time, and made results that nobody heard.
  msg::Header first = by_instance(104, 2, 90);
  first.trace()[2].index(101);
  accounting.receive(first);
  EXPECT_THAT(accounting.lost_by_site(),
              ElementsAre(Pair(LossSite{LossPlace::service, "walls"}, 3)));
  // The strong one returns without a gap, but not with its first result.
  msg::Header second = by_instance(105, 1050, 7);
  second.trace()[2].index(102);
  accounting.receive(second);
  EXPECT_EQ(accounting.lost(), 3U);
  EXPECT_EQ(accounting.received(), 3U);
  // What the standby made of the same scan comes late.
  accounting.receive(by_instance(105, 2, 91));
  EXPECT_EQ(accounting.verdict(), ScanAccounting::Verdict::duplicate);
  EXPECT_EQ(accounting.duplicates(), 1U);
}

TEST(ScanAccounting, WhatWasLostBehindATakeoverIsNotTheInstances) {
  ScanAccounting accounting;
  accounting.receive(by_instance(100, 1, 100));
  accounting.receive(by_instance(104, 2, 90));  // wctls made results of all three in between
  EXPECT_THAT(accounting.lost_by_site(), ElementsAre(Pair(LossSite{LossPlace::link}, 3)));
}

TEST(ScanAccounting, TheScansOfAnotherSourceAreNotComparedWithThoseBefore) {
  ScanAccounting accounting;
  accounting.receive(by_instance(100, 1, 100));
  msg::Header other = by_instance(5000, 1, 101);
  other.trace()[0].incarnation(3);
  other.trace()[2].index(101);
  EXPECT_THAT(accounting.receive(other), IsEmpty());
  EXPECT_EQ(accounting.received(), 2U);
  other = by_instance(120, 1, 102);
  other.trace()[0].published(6001);  // after the last of the other
  EXPECT_THAT(accounting.receive(other), IsEmpty()) << "the first one is heard again";
  EXPECT_EQ(accounting.received(), 3U);
}

TEST(ScanAccounting, ALateInstanceRepeatsNothingOfAnOldAndANewSource) {
  Pipeline pipeline;
  ScanAccounting accounting;
  std::int64_t clock = 10;
  const auto scan = [&](std::uint64_t started) {
    msg::Header header = pipeline.scan();
    header.trace()[0].incarnation(started);
    header.trace()[0].published(++clock);
    return header;
  };
  for (int i = 0; i < 10; ++i) EXPECT_THAT(accounting.receive(scan(1)), IsEmpty());
  std::vector<msg::Header> late;  // the strong instance of wctls stands still for a while
  for (int i = 0; i < 2; ++i) late.push_back(scan(1));
  pipeline.restart(0);
  const auto started = static_cast<std::uint64_t>(++clock);
  for (int i = 0; i < 5; ++i) {
    late.push_back(scan(started));
    msg::Header by_the_other = late.back();
    by_the_other.trace()[2].incarnation(2);
    accounting.receive(by_the_other);
  }
  EXPECT_EQ(accounting.received(), 15U);
  EXPECT_EQ(accounting.lost(), 2U) << "the last two of the old source";
  for (const msg::Header& header : late) {
    EXPECT_THAT(accounting.receive(header), IsEmpty());
    EXPECT_EQ(accounting.verdict(), ScanAccounting::Verdict::duplicate);
  }
  EXPECT_THAT(accounting.receive(scan(started)), IsEmpty());
  EXPECT_EQ(accounting.received(), 16U);
  EXPECT_EQ(accounting.lost(), 2U);
}

TEST(ScanAccounting, DoubledScansAreCountedApart) {
  Pipeline pipeline;
  ScanAccounting accounting;
  const msg::Header first = pipeline.scan();
  const msg::Header second = pipeline.scan();
  accounting.receive(first);
  accounting.receive(second);
  accounting.receive(second);
  accounting.receive(first);
  EXPECT_EQ(accounting.received(), 2U);
  EXPECT_EQ(accounting.duplicates(), 2U);
  EXPECT_EQ(accounting.lost(), 0U);
}

TEST(ScanAccounting, ALateMessageDoesNotLetItsSuccessorsCountTwice) {
  for (const std::int64_t second_start : {50'000'000'000LL, 500'000'000'000LL}) {
    SCOPED_TRACE(second_start);
    ScanAccounting accounting;
    const auto scan = [](std::int64_t started, std::uint64_t number) {
      msg::Header header = by_instance(number, 1, number);
      header.trace()[0].incarnation(static_cast<std::uint64_t>(started));
      header.trace()[0].published(started + static_cast<std::int64_t>(number));
      header.trace()[2].incarnation(static_cast<std::uint64_t>(started));
      return header;
    };
    accounting.receive(scan(1, 100));
    for (std::uint64_t i = 0; i < 20; ++i) {
      EXPECT_THAT(accounting.receive(scan(second_start, i)), IsEmpty());
    }
    EXPECT_THAT(accounting.receive(scan(1, 101)), IsEmpty());
    const bool may_be_of_another_clock = second_start > 60'000'000'000;
    EXPECT_EQ(accounting.verdict() == ScanAccounting::Verdict::duplicate, !may_be_of_another_clock);
    accounting.receive(scan(second_start, 23));
    EXPECT_EQ(accounting.lost(), 3U);
  }
}

TEST(ScanAccounting, WhatIsOlderThanTheFirstSourceThatWasHeardIsOfNone) {
  ScanAccounting accounting;
  msg::Header header = by_instance(5, 1, 5);
  header.trace()[0].incarnation(2000);
  header.trace()[0].published(3000);
  accounting.receive(header);
  accounting.receive(by_instance(100, 1, 4));  // published at 1100
  EXPECT_EQ(accounting.verdict(), ScanAccounting::Verdict::duplicate);
  EXPECT_EQ(accounting.sources().size(), 1U);
}

TEST(ScanAccounting, KeepsAnAccountOfEachProcessOfTheSource) {
  Pipeline pipeline;
  ScanAccounting accounting;
  for (int i = 0; i < 3; ++i) (void)pipeline.scan();
  for (int i = 0; i < 5; ++i) accounting.receive(pipeline.scan());
  for (int i = 0; i < 4; ++i) (void)pipeline.scan(2);  // of the old process, by walls
  pipeline.restart(0);
  (void)pipeline.scan(1);
  accounting.receive(pipeline.scan());
  ASSERT_EQ(accounting.sources().size(), 2U);
  const SourceAccount& first = accounting.sources()[0];
  EXPECT_EQ(first.incarnation, 1U);
  EXPECT_TRUE(first.begins);
  EXPECT_EQ(first.accounted, 3U + 5U + 3U) << "one of the four may be of the new process";
  const SourceAccount& second = accounting.sources()[1];
  EXPECT_EQ(second.incarnation, 2U);
  EXPECT_FALSE(second.begins);
  EXPECT_EQ(second.accounted, 2U);
  EXPECT_FALSE(first.handed_over);
  pipeline.take_over(0);
  accounting.receive(pipeline.scan());
  ASSERT_EQ(accounting.sources().size(), 3U);
  EXPECT_TRUE(accounting.sources()[1].handed_over);
  EXPECT_EQ(accounting.sources()[2].offset, 2U);
  accounting.interrupt();
  pipeline.restart(0);
  accounting.receive(pipeline.scan());
  EXPECT_TRUE(accounting.sources()[3].begins);
}

TEST(ScanAccounting, AHeaderWithoutTraceIsIgnored) {
  ScanAccounting accounting;
  EXPECT_THAT(accounting.receive(msg::Header{}), IsEmpty());
  EXPECT_EQ(accounting.received(), 0U);
}

}  // namespace
}  // namespace quoin::runtime
