// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/supervisor.hpp"

#include <algorithm>
#include <set>
#include <signal.h>

#include <gmock/gmock.h>

namespace quoin::deploy {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Supervises shell scripts instead of services and notes what happens.
class Supervision : public testing::Test {
 protected:
  ProcessPlan plan(const std::string& name, const std::string& script, int level = 0) {
    return {name, "/bin/sh", {"-c", script}, level, level == 0, true};
  }

  void start(std::vector<ProcessPlan> plans) {
    supervisor_.emplace(
        std::move(plans),
        Supervisor::Callbacks{
            .output = [this](const std::string& name,
                             const std::string& line) { lines_.push_back(name + ": " + line); },
            .event = [this](const std::string& name,
                            const std::string& text) { events_.push_back(name + ": " + text); },
            .was_active = [this](const std::string& name) { return active_.contains(name); }});
    supervisor_->start();
  }

  template <class Condition>
  bool poll_until(Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (!condition() && std::chrono::steady_clock::now() < deadline) supervisor_->poll(100ms);
    return condition();
  }
  bool poll_to_the_end() {
    return poll_until([this] { return supervisor_->ended(); });
  }
  bool wait_for_line(const std::string& line) {
    return poll_until([&] { return std::count(lines_.begin(), lines_.end(), line) > 0; });
  }

  std::vector<std::string> lines_;
  std::vector<std::string> events_;
  std::set<std::string> active_;
  std::optional<Supervisor> supervisor_;
};

// Waits for SIGTERM without leaving a process behind.
constexpr auto stage = "trap 'echo stopped; exit 0' TERM; echo ready; while :; do sleep 0.05; done";

TEST_F(Supervision, ForwardsOutputLineByLine) {
  start({plan("front", "echo one; echo two >&2; printf three")});
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_THAT(lines_, ElementsAre("front: one", "front: two", "front: three"));
  EXPECT_EQ(supervisor_->exit_code(), 0);
  EXPECT_EQ(supervisor_->figures("front").phase, ProcessPhase::finished);
}

TEST_F(Supervision, TellsAProcessThatIsStartedAgainOnceItHasBeenActive) {
  ProcessPlan walls = plan("walls", "echo \"$0 $#\"; test $# -gt 0", 1);
  walls.arguments.push_back("first");
  walls.again = {"--reader-timeout", "2"};
  start({walls});
  ASSERT_TRUE(poll_until([this] { return supervisor_->figures("walls").restarts == 2; }));
  active_.insert("walls");
  ASSERT_TRUE(wait_for_line("walls: first 2"));
  EXPECT_THAT(lines_, Contains("walls: first 0"));
}

TEST_F(Supervision, GivesNoInput) {
  start({plan("front", "cat; echo end")});
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_THAT(lines_, ElementsAre("front: end"));
}

TEST_F(Supervision, GoesOnWithoutSourcesUntilAskedToStop) {
  start({plan("walls", stage, 1), plan("lines", stage, 2)});
  ASSERT_TRUE(wait_for_line("walls: ready"));
  ASSERT_TRUE(wait_for_line("lines: ready"));
  EXPECT_FALSE(supervisor_->stopping());
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, DrainsTheStagesLevelByLevelWhenTheSourcesHaveFinished) {
  start({plan("front", "read never < /dev/null; sleep 0.5"), plan("walls", stage, 1),
         plan("lines", stage, 2)});
  ASSERT_TRUE(wait_for_line("walls: ready"));
  ASSERT_TRUE(wait_for_line("lines: ready"));
  lines_.clear();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_THAT(lines_, ElementsAre("walls: stopped", "lines: stopped"));
  EXPECT_THAT(events_, IsEmpty());
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, StopsSourcesFirst) {
  start({plan("front", stage), plan("walls", stage, 1)});
  ASSERT_TRUE(wait_for_line("front: ready"));
  ASSERT_TRUE(wait_for_line("walls: ready"));
  lines_.clear();
  supervisor_->request_stop();
  EXPECT_TRUE(supervisor_->stopping());
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_THAT(lines_, ElementsAre("front: stopped", "walls: stopped"));
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, StartsAgainWhatDies) {
  start({plan("front", stage), plan("walls", stage, 1)});
  ASSERT_TRUE(wait_for_line("walls: ready"));
  const int first = supervisor_->figures("walls").process_id;
  ASSERT_EQ(::kill(first, SIGKILL), 0);
  ASSERT_TRUE(poll_until([&] { return supervisor_->figures("walls").restarts == 1; }));
  EXPECT_THAT(events_, ElementsAre(testing::AllOf(HasSubstr("walls: process"),
                                                  HasSubstr("signal 9 (Killed)"),
                                                  HasSubstr("starting again in 0.2 s"))));
  const int second = supervisor_->figures("walls").process_id;
  EXPECT_NE(first, second);
  EXPECT_TRUE(supervisor_->started(first));
  EXPECT_TRUE(supervisor_->started(second));
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, LeavesDeadWhatShallNotBeStartedAgain) {
  ProcessPlan walls = plan("walls", "exit 7", 1);
  walls.restart = false;
  start({plan("front", stage), walls});
  ASSERT_TRUE(
      poll_until([&] { return supervisor_->figures("walls").phase == ProcessPhase::dead; }));
  EXPECT_THAT(events_,
              ElementsAre(testing::AllOf(HasSubstr("exit code 7"), HasSubstr("stays dead"))));
  EXPECT_FALSE(supervisor_->stopping());
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 1);
}

TEST_F(Supervision, StopsAllWhenAConfigurationIsRejectedAtTheStart) {
  start({plan("front", stage), plan("walls", "echo wrong; exit 2", 1)});
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_THAT(lines_, Contains("walls: wrong"));
  EXPECT_EQ(supervisor_->exit_code(), 2);
}

TEST_F(Supervision, StartsAgainWhenAConfigurationWorkedBefore) {
  active_ = {"walls"};
  start({plan("front", stage), plan("walls", "exit 2", 1)});
  ASSERT_TRUE(poll_until([&] { return supervisor_->figures("walls").restarts == 1; }));
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_NE(supervisor_->exit_code(), 2);
}

TEST_F(Supervision, EndsWithThreeWhenTheInputOfASourceIsUnusable) {
  start({plan("front", "exit 3"), plan("walls", stage, 1)});
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 3);
  EXPECT_EQ(supervisor_->figures("front").restarts, 0U);
  EXPECT_EQ(supervisor_->figures("front").phase, ProcessPhase::dead);
}

TEST_F(Supervision, GoesOnUntilTheLastSourceHasEnded) {
  start({plan("front", "exit 0"), plan("rear", stage)});
  ASSERT_TRUE(wait_for_line("rear: ready"));
  ASSERT_TRUE(
      poll_until([&] { return supervisor_->figures("front").phase == ProcessPhase::finished; }));
  EXPECT_FALSE(supervisor_->stopping());
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
}

TEST_F(Supervision, KillAllEndsWhoeverIgnoresTheStop) {
  start({plan("front", "trap '' TERM; echo ready; exec sleep 600"), plan("walls", stage, 1)});
  ASSERT_TRUE(wait_for_line("front: ready"));
  const int process = supervisor_->figures("front").process_id;
  supervisor_->kill_all();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(::kill(process, 0), -1);
  EXPECT_NE(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, KillsAfterFiveSecondsWhoeverIgnoresTheStop) {
  start({plan("front", "trap '' TERM; echo ready; exec sleep 600")});
  ASSERT_TRUE(wait_for_line("front: ready"));
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_THAT(events_, Contains(HasSubstr("did not stop within 5.0 s; killing it")));
  EXPECT_EQ(supervisor_->exit_code(), 1);
}

TEST_F(Supervision, SaysWhenAProgramCannotBeExecuted) {
  ProcessPlan missing = plan("front", "");
  missing.program = "/nonexistent/quoin-simulated";
  missing.restart = false;
  start({missing});
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_THAT(lines_, ElementsAre(HasSubstr("cannot be executed")));
  EXPECT_EQ(supervisor_->exit_code(), 1);
}

TEST_F(Supervision, AProcessOnTrialTakesThePlaceOfAnother) {
  start({plan("front", stage), plan("walls", stage, 1)});
  ASSERT_TRUE(wait_for_line("walls: ready"));
  lines_.clear();
  const int old = supervisor_->key_of("walls").value();
  const int young = supervisor_->add(plan("walls", stage, 1));
  ASSERT_TRUE(wait_for_line("walls: ready"));
  EXPECT_EQ(supervisor_->key_of("walls"), old);
  EXPECT_EQ(supervisor_->figures("walls").process_id, supervisor_->process_id(old));
  supervisor_->adopt(young, plan("walls", stage, 1));
  supervisor_->retire(old, true);
  ASSERT_TRUE(poll_until([&] { return !supervisor_->running(old); }));
  EXPECT_EQ(supervisor_->key_of("walls"), young);
  supervisor_->poll(0ms);
  supervisor_->retire(old, true);  // is forgotten
  supervisor_->kill(old);
  EXPECT_THAT(events_, IsEmpty());
  ASSERT_EQ(::kill(supervisor_->process_id(young), SIGKILL), 0);
  ASSERT_TRUE(poll_until([&] { return supervisor_->figures("walls").restarts == 1; }));
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, ADeadProcessThatIsRetiredIsNotStartedAgain) {
  start({plan("front", stage), plan("walls", stage, 1)});
  ASSERT_TRUE(wait_for_line("walls: ready"));
  const int old = supervisor_->key_of("walls").value();
  supervisor_->kill(old);
  ASSERT_TRUE(
      poll_until([&] { return supervisor_->figures("walls").phase == ProcessPhase::pausing; }));
  const int young = supervisor_->add(plan("walls", stage, 1));
  supervisor_->adopt(young, plan("walls", stage, 1));
  supervisor_->retire(old, false);
  lines_.clear();
  supervisor_->kill(young);  // it comes back after the same pause, or a longer one
  ASSERT_TRUE(wait_for_line("walls: ready"));
  EXPECT_EQ(std::ranges::count(lines_, "walls: ready"), 1);
  EXPECT_EQ(supervisor_->key_of("walls"), young);
  EXPECT_FALSE(supervisor_->running(old));
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
}

TEST_F(Supervision, AFailedTrialChangesNothing) {
  start({plan("front", stage)});
  const int key = supervisor_->add(plan("walls", "echo wrong; exit 2", 1));
  ASSERT_TRUE(poll_until([&] { return supervisor_->end_of_trial(key).has_value(); }));
  EXPECT_TRUE(supervisor_->end_of_trial(key)->exited_with(2));
  EXPECT_THAT(lines_, Contains("walls: wrong"));
  supervisor_->retire(key, true);
  supervisor_->poll(0ms);
  EXPECT_FALSE(supervisor_->stopping());
  EXPECT_EQ(supervisor_->key_of("walls"), std::nullopt);
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, AFailedTrialOfASourceDoesNotEndWhatHasNone) {
  start({plan("walls", stage, 1)});
  const int key = supervisor_->add(plan("front", "exit 2"));
  ASSERT_TRUE(poll_until([&] { return supervisor_->end_of_trial(key).has_value(); }));
  supervisor_->poll(0ms);
  EXPECT_FALSE(supervisor_->stopping());
  supervisor_->retire(key, true);
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, TheFiguresOfARemovedServiceStay) {
  start({plan("front", stage), plan("walls", stage, 1)});
  ASSERT_TRUE(wait_for_line("walls: ready"));
  const int key = supervisor_->key_of("walls").value();
  const int process = supervisor_->process_id(key);
  supervisor_->retire(key, true);
  ASSERT_TRUE(poll_until([&] { return !supervisor_->running(key); }));
  EXPECT_EQ(supervisor_->key_of("walls"), std::nullopt);
  EXPECT_EQ(supervisor_->figures("walls").process_id, process);
  supervisor_->request_stop();
  ASSERT_TRUE(poll_to_the_end());
  EXPECT_EQ(supervisor_->exit_code(), 0);
}

TEST_F(Supervision, UnknownNamesHaveNoFigures) {
  start({plan("front", "exit 0")});
  EXPECT_THROW((void)supervisor_->figures("rear"), std::out_of_range);
}

TEST_F(Supervision, AProcessOfSeveralServicesIsKnownUntilEachHasASuccessor) {
  ProcessPlan both = plan("both", stage, 1);
  both.services = {"walls", "lines"};
  start({both});
  ASSERT_TRUE(wait_for_line("both: ready"));
  const int old = supervisor_->key_of("walls").value();
  EXPECT_EQ(supervisor_->key_of("lines"), old);
  const int walls = supervisor_->add(plan("walls", stage, 1));
  const int lines = supervisor_->add(plan("lines", stage, 1));
  ASSERT_TRUE(wait_for_line("lines: ready"));
  supervisor_->adopt(walls, plan("walls", stage, 1));
  supervisor_->retire(old, true, 2);
  ASSERT_TRUE(poll_until([&] { return !supervisor_->running(old); }));
  supervisor_->poll(0ms);
  EXPECT_EQ(supervisor_->figures("lines").phase, ProcessPhase::finished) << "it has no successor";
  supervisor_->adopt(lines, plan("lines", stage, 1));
  supervisor_->poll(0ms);
  EXPECT_EQ(supervisor_->key_of("lines"), lines);
  EXPECT_EQ(supervisor_->figures("lines").phase, ProcessPhase::running);
  supervisor_->request_stop();
  EXPECT_TRUE(poll_to_the_end());
}

}  // namespace
}  // namespace quoin::deploy
