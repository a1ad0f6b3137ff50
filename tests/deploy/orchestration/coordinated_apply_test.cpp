// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/coordinated_apply.hpp"

#include <set>

#include <gmock/gmock.h>

#include "tests/deploy/orchestration/fakes.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using msg::ControlAction;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// Supervisors that plan `steps` and do what they are told, as their hosts' logs show.
class ApplyOn : public testing::Test {
 protected:
  using Steps = std::vector<std::pair<std::string, std::string>>;  // action, service

  std::vector<HostOutcome> apply(const std::vector<std::string>& hosts) {
    requester_.on_request = [this](const msg::ControlRequest& request) { answer(request); };
    msg::ControlRequest request;
    request.action(ControlAction::CONTROL_APPLY);
    request.wait(10.0);
    return apply_on(
        hosts,
        deployment({service("front", lidar), service("fit", fitter, {{"scan", "front"}}),
                    service("map", mapper, {{"lines", "fit"}, {"odometry", "front"}}, "plain")}),
        requester_, request, [this] { return interrupted_; });
  }

  void answer(const msg::ControlRequest& request) {
    const std::string host = request.service().substr(supervisor_name("").size());
    if (dead_.contains(request.service())) return;
    switch (request.action()) {
      case ControlAction::CONTROL_APPLY:
        applies_[request.service()] = request;
        plan(request);
        break;
      case ControlAction::CONTROL_PROCEED:
        log_.emplace_back(request.service(), request.change().empty() ? "rest" : request.change());
        if (request.change().empty()) {
          finish(request.service(), true, "");
        } else if (!stuck_.contains(request.service())) {
          requester_.accept(request);
        }
        break;
      case ControlAction::CONTROL_WITHDRAW:
        log_.emplace_back(request.service(), "withdraw");
        finish(request.service(), false, "withdrawn");
        break;
      default:
        break;
    }
  }
  void plan(const msg::ControlRequest& request) {
    if (refusing_.contains(request.service())) {
      finish(request.service(), false, "no such device");
      return;
    }
    msg::ControlReply plan;
    plan.service(request.service());
    plan.accepted(true);
    plan.pending(true);
    for (const auto& [action, name] : steps_[request.service()]) {
      msg::ControlStep& step = plan.steps().emplace_back();
      step.action(action);
      step.service(name);
    }
    requester_.reply(request.request(), plan);
    if (!request.coordinated()) {
      finish(request.service(), true, "");
      return;
    }
    msg::ControlReply ready;
    ready.service(request.service());
    ready.accepted(true);
    ready.pending(true);
    ready.ready(true);
    if (!slow_.contains(request.service())) requester_.reply(request.request(), ready);
  }
  void finish(const std::string& supervisor, bool accepted, const std::string& detail) {
    msg::ControlReply last;
    last.service(supervisor);
    last.accepted(accepted);
    last.detail(detail);
    last.rolled_back(!accepted);
    requester_.reply(applies_.at(supervisor).request(), last);
  }

  const std::string base_ = supervisor_name("base");
  const std::string cabin_ = supervisor_name("cabin");
  FakeRequester requester_;
  std::map<std::string, Steps> steps_;                    // by supervisor
  std::vector<std::pair<std::string, std::string>> log_;  // supervisor, what it was told
  std::set<std::string> dead_, refusing_, slow_, stuck_;  // supervisors
  std::map<std::string, msg::ControlRequest> applies_;
  bool interrupted_ = false;
};

TEST_F(ApplyOn, OneHostGoesOnByItself) {
  steps_[supervisor_name("")] = {{"replace", "map"}};
  const auto outcomes = apply({""});
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_TRUE(outcomes[0].reply.accepted());
  EXPECT_TRUE(outcomes[0].answered);
  EXPECT_EQ(outcomes[0].reply.steps().size(), 1U) << "the plan, which came first";
  EXPECT_THAT(log_, IsEmpty());
}

TEST_F(ApplyOn, NewReadersComeFirstThenReplacementsFromTheSourcesOn) {
  steps_[base_] = {{"replace", "front"}, {"start", "map"}};
  steps_[cabin_] = {{"start", "fit"}};
  const auto outcomes = apply({"base", "cabin"});
  EXPECT_THAT(log_, ElementsAre(Pair(base_, "map"), Pair(cabin_, "fit"), Pair(base_, "front"),
                                Pair(base_, "rest"), Pair(cabin_, "rest")));
  for (const HostOutcome& outcome : outcomes) EXPECT_TRUE(outcome.reply.accepted());
}

TEST_F(ApplyOn, AServiceThatMovesEndsBeforeItBegins) {
  steps_[base_] = {{"stop", "fit"}};
  steps_[cabin_] = {{"start", "fit"}};
  (void)apply({"base", "cabin"});
  EXPECT_THAT(log_, ElementsAre(Pair(base_, "fit"), Pair(cabin_, "fit"), Pair(base_, "rest"),
                                Pair(cabin_, "rest")));
}

TEST_F(ApplyOn, AHostThatRefusesKeepsAllFromChanging) {
  refusing_ = {cabin_};
  steps_[base_] = {{"replace", "front"}};
  const auto outcomes = apply({"base", "cabin"});
  EXPECT_THAT(log_, ElementsAre(Pair(base_, "withdraw")));
  EXPECT_FALSE(outcomes[0].reply.accepted());
  EXPECT_EQ(outcomes[1].reply.detail(), "no such device");
}

TEST_F(ApplyOn, AHostThatDoesNotAnswerKeepsAllFromChanging) {
  dead_ = {cabin_};
  const auto begin = requester_.now();
  const auto outcomes = apply({"base", "cabin"});
  EXPECT_THAT(log_, ElementsAre(Pair(base_, "withdraw")));
  EXPECT_TRUE(outcomes[0].answered);
  EXPECT_FALSE(outcomes[1].answered);
  EXPECT_FALSE(outcomes[1].reply.accepted());
  EXPECT_GE(requester_.now() - begin, seconds(5));
  EXPECT_LT(requester_.now() - begin, seconds(6));
}

TEST_F(ApplyOn, AHostThatIsNeverReadyKeepsAllFromChanging) {
  slow_ = {cabin_};
  const auto begin = requester_.now();
  (void)apply({"base", "cabin"});
  EXPECT_EQ(log_.front(), (std::pair<std::string, std::string>(base_, "withdraw")));
  EXPECT_GE(requester_.now() - begin, seconds(20)) << "as long as it may take, and ten more";
}

TEST_F(ApplyOn, InterruptedInTimeNothingChanges) {
  interrupted_ = true;
  (void)apply({"base", "cabin"});
  EXPECT_THAT(log_, ElementsAre(Pair(base_, "withdraw"), Pair(cabin_, "withdraw")));
}

TEST_F(ApplyOn, AHostThatFailsInTheMiddleHoldsUpTheOthersOnce) {
  stuck_ = {cabin_};
  steps_[base_] = {{"replace", "map"}};
  steps_[cabin_] = {{"replace", "front"}, {"replace", "fit"}};
  const auto begin = requester_.now();
  (void)apply({"base", "cabin"});
  EXPECT_THAT(log_, ElementsAre(Pair(cabin_, "front"), Pair(base_, "map"), Pair(base_, "rest"),
                                Pair(cabin_, "rest")));
  EXPECT_LT(requester_.now() - begin, seconds(30));
}

}  // namespace
}  // namespace quoin::deploy
