// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/dialogue.hpp"

#include <gmock/gmock.h>

#include "tests/deploy/orchestration/fakes.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using msg::ControlAction;
using std::chrono::milliseconds;
using testing::HasSubstr;

/// A service "map" with process 1.
class DialogueTest : public testing::Test {
 protected:
  DialogueTest() { processes_.insert("map"); }

  [[nodiscard]] static ServiceConfig map(const std::string& method) {
    return service("map", mapper, {{"lines", "fit"}, {"odometry", "front"}}, method);
  }
  [[nodiscard]] milliseconds elapsed() const {
    return std::chrono::duration_cast<milliseconds>(requester_.now() - begin_);
  }
  void accept_all() {
    requester_.on_request = [this](const msg::ControlRequest& request) {
      requester_.accept(request);
    };
  }

  FakeRequester requester_;
  FakeProcesses processes_;
  Requester::Clock::time_point begin_ = requester_.now();
  Dialogue dialogue_{processes_, requester_, [this] {
                       requester_.wait_for_any(milliseconds(10));
                       return !processes_.stopping();
                     }};
};

TEST_F(DialogueTest, GivesTheAnswer) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    msg::ControlReply reply;
    reply.accepted(true);
    reply.held_scans(4);
    requester_.reply(request.request(), reply);
  };
  const auto reply = dialogue_.ask("map", 17, ControlAction::CONTROL_HOLD);
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(reply->held_scans(), 4U);
  ASSERT_EQ(requester_.sent.size(), 1U);
  EXPECT_EQ(requester_.sent[0].service(), "map");
  EXPECT_EQ(requester_.sent[0].incarnation(), 17U);
  EXPECT_EQ(requester_.sent[0].action(), ControlAction::CONTROL_HOLD);
}

TEST_F(DialogueTest, GivesARefusalAsItIs) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    msg::ControlReply reply;
    reply.detail("is at work already");
    requester_.reply(request.request(), reply);
  };
  const auto reply = dialogue_.ask("map", 17, ControlAction::CONTROL_HOLD);
  ASSERT_TRUE(reply.has_value());
  EXPECT_FALSE(reply->accepted());
  EXPECT_EQ(reply->detail(), "is at work already");
}

TEST_F(DialogueTest, SendsWhatChangesSomethingOnceAndGivesUp) {
  EXPECT_FALSE(dialogue_.ask("map", 17, ControlAction::CONTROL_HOLD).has_value());
  EXPECT_EQ(requester_.sent.size(), 1U);
  EXPECT_GE(elapsed(), milliseconds(5500)) << "a service has five seconds to answer";
  EXPECT_LT(elapsed(), milliseconds(6000));
}

TEST_F(DialogueTest, RepeatsAQuestionBecauseTheFirstMayGetLost) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    if (requester_.sent.size() == 3) requester_.accept(request);
  };
  EXPECT_TRUE(dialogue_.ask("map", 17, ControlAction::CONTROL_DESCRIBE).has_value());
  EXPECT_EQ(requester_.sent.size(), 3U);
}

TEST_F(DialogueTest, GivesUpAskingAServiceThatIsGone) {
  EXPECT_FALSE(dialogue_.ask("map", 17, ControlAction::CONTROL_DESCRIBE).has_value());
  EXPECT_GE(elapsed(), milliseconds(3000));
  EXPECT_LT(elapsed(), milliseconds(3500));
}

TEST_F(DialogueTest, GivesUpWhenTheDeploymentStops) {
  processes_.stop = true;
  EXPECT_FALSE(dialogue_.ask("map", 17, ControlAction::CONTROL_DESCRIBE).has_value());
  EXPECT_FALSE(dialogue_.ask("map", 17, ControlAction::CONTROL_HOLD).has_value());
  EXPECT_EQ(requester_.sent.size(), 2U);
  EXPECT_LT(elapsed(), milliseconds(100));
}

TEST_F(DialogueTest, AnAnswerToAnotherRequestIsNone) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    requester_.reply(request.request() + 100, {});
  };
  EXPECT_FALSE(dialogue_.ask("map", 17, ControlAction::CONTROL_HOLD).has_value());
}

TEST_F(DialogueTest, WaitsUntilAConditionHolds) {
  int looks = 0;
  EXPECT_TRUE(dialogue_.wait_until([&] { return ++looks == 5; }, milliseconds(1000)));
  EXPECT_EQ(elapsed(), milliseconds(40));
  EXPECT_FALSE(dialogue_.wait_until([] { return false; }, milliseconds(100)));
  EXPECT_EQ(elapsed(), milliseconds(140));
}

TEST_F(DialogueTest, SwapsTheMethodOfAServiceThatAnswers) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    msg::ControlReply reply;
    reply.accepted(true);
    reply.first_sequence_number(31);
    requester_.reply(request.request(), reply);
  };
  ServiceConfig wanted = map("grid");
  wanted.parameters = {{"cell", "5 cm"}};
  const Dialogue::Swap swap = dialogue_.swap(wanted);
  EXPECT_EQ(swap.refusal, "");
  EXPECT_EQ(swap.first_scan, 31U);
  ASSERT_EQ(requester_.sent.size(), 2U);
  EXPECT_EQ(requester_.sent[0].action(), ControlAction::CONTROL_DESCRIBE);
  const msg::ControlRequest& request = requester_.sent[1];
  EXPECT_EQ(request.action(), ControlAction::CONTROL_SWAP_METHOD);
  EXPECT_EQ(request.method(), "grid");
  EXPECT_TRUE(request.drop_state());
  ASSERT_EQ(request.parameters().size(), 1U);
  EXPECT_EQ(request.parameters()[0].name(), "cell");
  EXPECT_EQ(request.parameters()[0].value(), "5 cm");
}

TEST_F(DialogueTest, ASwapThatIsRefusedSaysWhy) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    if (request.action() == ControlAction::CONTROL_DESCRIBE) return requester_.accept(request);
    msg::ControlReply reply;
    reply.detail("cell must be positive");
    requester_.reply(request.request(), reply);
  };
  const Dialogue::Swap swap = dialogue_.swap(map("grid"));
  EXPECT_THAT(swap.refusal, HasSubstr("cell must be positive"));
  EXPECT_FALSE(swap.first_scan.has_value());
}

TEST_F(DialogueTest, NothingIsSwappedInAServiceThatDoesNotAnswer) {
  EXPECT_NE(dialogue_.swap(map("grid")).refusal, "");
  EXPECT_EQ(requester_.count(ControlAction::CONTROL_SWAP_METHOD), 0U);
}

TEST_F(DialogueTest, AServiceThatDisappearsDuringASwapIsReported) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    if (request.action() == ControlAction::CONTROL_DESCRIBE) requester_.accept(request);
  };
  EXPECT_NE(dialogue_.swap(map("grid")).refusal, "");
  EXPECT_EQ(requester_.count(ControlAction::CONTROL_SWAP_METHOD), 1U);
}

TEST_F(DialogueTest, DescribesTheMethodInForce) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    msg::ControlReply reply;
    reply.accepted(true);
    reply.method("grid");
    msg::ParameterSetting cell;
    cell.name("cell");
    cell.value("0.05");
    reply.parameters({cell});
    requester_.reply(request.request(), reply);
  };
  const Deployment described = dialogue_.describe(deployment({map("plain")}));
  EXPECT_EQ(described.service("map").method, "grid");
  ASSERT_EQ(described.service("map").parameters.size(), 1U);
  EXPECT_EQ(described.service("map").parameters[0].text, "0.05");
}

TEST_F(DialogueTest, AMethodThatNobodyKnowsIsNotTakenOver) {
  requester_.on_request = [this](const msg::ControlRequest& request) {
    msg::ControlReply reply;
    reply.method("of another build");
    requester_.reply(request.request(), reply);
  };
  EXPECT_EQ(dialogue_.describe(deployment({map("plain")})).service("map").method, "plain");
}

TEST_F(DialogueTest, AServiceThatDoesNotAnswerIsTakenAsTheFileDescribesIt) {
  EXPECT_EQ(dialogue_.describe(deployment({map("plain")})).service("map").method, "plain");
  EXPECT_GE(elapsed(), milliseconds(1000));
  EXPECT_LT(elapsed(), milliseconds(1500));
}

TEST_F(DialogueTest, AsksOnlyServicesThatRunHereAndHaveMethods) {
  accept_all();
  (void)dialogue_.describe(deployment({service("front", lidar), map("plain"),
                                       service("other", mapper, {{"lines", "fit"}}, "plain")}));
  ASSERT_EQ(requester_.sent.size(), 1U);
  EXPECT_EQ(requester_.sent[0].service(), "map");
}

TEST(Requester, ReachesAServiceOnceItAnswersAnything) {
  FakeRequester requester;
  requester.on_request = [&](const msg::ControlRequest& request) {
    if (requester.sent.size() == 4) requester.reply(request.request(), {});
  };
  EXPECT_TRUE(requester.reach("map", requester.now() + std::chrono::seconds(5)));
  EXPECT_EQ(requester.sent.size(), 4U);
}

TEST(Requester, DoesNotReachAServiceThatIsNotThere) {
  FakeRequester requester;
  const auto deadline = requester.now() + std::chrono::seconds(1);
  EXPECT_FALSE(requester.reach("map", deadline));
  EXPECT_GE(requester.now(), deadline);
}

}  // namespace
}  // namespace quoin::deploy
