// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/ports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

/// A writer whose readers make room after some tries, each of which takes a tenth of a second.
class DeliveryTest : public testing::Test {
 protected:
  DeliveryTest() {
    output_.header().trace().emplace_back();
    topic_->room = [this] {
      clock_.advance(milliseconds(100));
      if (on_try) on_try();
      return ++tries_ > refusals_;
    };
  }
  bool deliver(bool lossless) {
    return runtime::deliver(output_, output_.header().trace().back(), lossless, thread_);
  }
  std::string detail() { return record_.snapshot().detail(); }

  ManualClock clock_;
  ServiceRecord record_{ServiceConfig{}};
  Pulse pulse_;
  bool stopping_ = false;
  DataThread thread_{record_, pulse_, [this] { return stopping_; },
                     [this] { return clock_.now(); }};
  std::shared_ptr<MemoryTopic<msg::Segments>> topic_ =
      std::make_shared<MemoryTopic<msg::Segments>>();
  MemoryOutput<msg::Segments> output_{topic_};
  std::function<void()> on_try;
  int tries_ = 0;
  int refusals_ = 0;
};

TEST_F(DeliveryTest, AMessageThatIsTakenCarriesTheTimeOfItsPublication) {
  const std::int64_t before = now_ns();
  EXPECT_TRUE(deliver(false));
  EXPECT_GE(topic_->written.at(0).header().trace().back().published(), before);
  EXPECT_EQ(tries_, 1);
}

TEST_F(DeliveryTest, WithoutThePresetItIsTriedOnce) {
  refusals_ = 1;
  EXPECT_FALSE(deliver(false));
  EXPECT_EQ(tries_, 1);
}

TEST_F(DeliveryTest, LosslessIsTriedUntilThereIsRoom) {
  refusals_ = 100;
  EXPECT_TRUE(deliver(true));
  EXPECT_EQ(tries_, 101);
  EXPECT_EQ(topic_->written.size(), 1U);
}

TEST_F(DeliveryTest, SaysForWhomItWaitsAndTakesItBack) {
  refusals_ = 60;
  topic_->silent = {"wctls", "pose"};
  std::vector<std::string> details;
  on_try = [&] {
    if (details.empty() || details.back() != detail()) details.push_back(detail());
    if (tries_ == 40) topic_->silent = {"pose"};
  };
  EXPECT_TRUE(deliver(true));
  ASSERT_EQ(details.size(), 3U);
  EXPECT_EQ(details[0], "");
  EXPECT_THAT(details[1], HasSubstr("wctls, pose"));
  EXPECT_THAT(details[2], HasSubstr(": pose"));
  EXPECT_EQ(detail(), "");
}

TEST_F(DeliveryTest, AReaderThatIsOnlySlowIsNotMentioned) {
  refusals_ = 15;  // less than two seconds
  topic_->silent = {"wctls"};
  on_try = [&] { EXPECT_EQ(detail(), ""); };
  EXPECT_TRUE(deliver(true));
}

TEST_F(DeliveryTest, EndsWithinItsBoundAfterAStop) {
  refusals_ = 1000;
  std::chrono::steady_clock::time_point stopped;
  on_try = [&] {
    if (tries_ != 50) return;
    stopping_ = true;
    stopped = clock_.now();
  };
  EXPECT_FALSE(deliver(true));
  EXPECT_GE(clock_.now() - stopped, longest_wait_for_room);
  EXPECT_LE(clock_.now() - stopped, longest_wait_for_room + milliseconds(100));
  EXPECT_EQ(detail(), "");
}

TEST_F(DeliveryTest, AStoppedServiceStillDeliversWhatFindsRoomInTime) {
  refusals_ = 5;
  stopping_ = true;
  EXPECT_TRUE(deliver(true));
}

TEST_F(DeliveryTest, ShowsThatItLivesWhileItWaits) {
  refusals_ = 10;
  const auto begin = Pulse::Clock::now();
  EXPECT_TRUE(deliver(true));
  EXPECT_TRUE(pulse_.alive(begin, std::chrono::seconds(0)));
  EXPECT_FALSE(pulse_.alive(begin + std::chrono::hours(1), std::chrono::seconds(0)))
      << "it has beaten";
}

}  // namespace
}  // namespace quoin::runtime
