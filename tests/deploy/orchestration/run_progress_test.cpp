// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/run_progress.hpp"

#include <algorithm>

#include <gmock/gmock.h>

#include "tests/deploy/observation/pipeline.hpp"
#include "tests/deploy/orchestration/fakes.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using std::chrono::seconds;
using Event = ActiveTime::Event;

constexpr ActiveTime::Clock::time_point begin{};

TEST(ActiveTime, BeginsWhenAllServicesAreActive) {
  ActiveTime time(0.0, begin);
  EXPECT_EQ(time.update(false, false, begin + seconds(1)), Event::none);
  EXPECT_EQ(time.seconds(begin + seconds(2)), 0.0);
  EXPECT_EQ(time.update(true, false, begin + seconds(3)), Event::active);
  EXPECT_EQ(time.update(true, false, begin + seconds(4)), Event::none) << "once is enough";
  EXPECT_EQ(time.start_seconds(), 3.0);
  EXPECT_EQ(time.seconds(begin + seconds(5)), 2.0);
}

TEST(ActiveTime, EndsWhenTheDeploymentStops) {
  ActiveTime time(0.0, begin);
  (void)time.update(true, false, begin);
  EXPECT_EQ(time.update(true, true, begin + seconds(7)), Event::none);
  EXPECT_EQ(time.update(true, true, begin + seconds(8)), Event::none);
  EXPECT_EQ(time.seconds(begin + seconds(9)), 7.0);
}

TEST(ActiveTime, ALateStartIsReportedOnce) {
  ActiveTime time(0.0, begin);
  EXPECT_EQ(time.update(false, false, begin + seconds(29)), Event::none);
  EXPECT_EQ(time.update(false, false, begin + seconds(30)), Event::late);
  EXPECT_EQ(time.update(false, false, begin + seconds(31)), Event::none);
  EXPECT_EQ(time.update(true, false, begin + seconds(32)), Event::active);
}

TEST(ActiveTime, IsOverAfterItsDuration) {
  ActiveTime time(5.0, begin);
  (void)time.update(true, false, begin + seconds(10));
  EXPECT_EQ(time.update(true, false, begin + seconds(14)), Event::none);
  EXPECT_EQ(time.update(true, false, begin + seconds(15)), Event::over);
}

TEST(ActiveTime, WithoutADurationItIsNeverOver) {
  ActiveTime time(0.0, begin);
  (void)time.update(true, false, begin);
  EXPECT_EQ(time.update(true, false, begin + std::chrono::hours(100)), Event::none);
}

class RunFigures : public testing::Test {
 protected:
  [[nodiscard]] ServiceReport report() const {
    return run_figures(record_, processes_, 4.0).services.at(0).report;
  }
  void hear(msg::ServiceState state) {
    msg::ServiceStatus status = heartbeat("front", 7, 20, state);
    status.pid(static_cast<std::uint32_t>(processes_.id(key_)));
    status.rate(10.0);
    record_.receive(status);
  }
  const Deployment deployment_ = deployment({service("front", lidar)});
  DeploymentRecord record_{deployment_, "", [](std::size_t, const Connection&) {}};
  FakeProcesses processes_;
  int key_ = processes_.insert("front");
};

TEST_F(RunFigures, AProcessThatHasReportedNothingIsStarting) {
  EXPECT_EQ(report().state, "starting");
  hear(msg::STATE_ACTIVE);
  EXPECT_EQ(report().state, "active");
  EXPECT_EQ(report().rate, 10.0);
}

TEST_F(RunFigures, AProcessThatIsStartedAgainReplacesTheStateOfTheOneBefore) {
  hear(msg::STATE_ACTIVE);
  processes_.phases["front"] = {ProcessPhase::running, 5555, 1};
  EXPECT_EQ(report().state, "starting");
  EXPECT_EQ(run_figures(record_, processes_, 4.0).services.at(0).restarts, 1U);
}

TEST_F(RunFigures, ADeadProcessHasNoRate) {
  hear(msg::STATE_ACTIVE);
  processes_.phases["front"] = {ProcessPhase::pausing, processes_.id(key_), 1};
  EXPECT_EQ(report().state, "restarting");
  EXPECT_EQ(report().rate, 0.0);
  processes_.phases["front"].phase = ProcessPhase::dead;
  EXPECT_EQ(report().state, "dead");
  EXPECT_EQ(report().rate, 0.0);
}

TEST_F(RunFigures, AFailureThatWasReportedStands) {
  hear(msg::STATE_FAILED);
  processes_.phases["front"] = {ProcessPhase::dead, processes_.id(key_), 0};
  EXPECT_EQ(report().state, "failed");
}

TEST_F(RunFigures, AnOrderlyEndIsOneEvenIfItWasNotReported) {
  processes_.phases["front"] = {ProcessPhase::finished, processes_.id(key_), 0};
  EXPECT_EQ(report().state, "finished");
  hear(msg::STATE_ACTIVE);
  EXPECT_EQ(report().state, "finished");
  hear(msg::STATE_STOPPED);
  EXPECT_EQ(report().state, "stopped");
}

TEST_F(RunFigures, ARemovedServiceIsCalledSo) {
  hear(msg::STATE_ACTIVE);
  record_.confirm(deployment({}));
  EXPECT_EQ(report().state, "removed");
  EXPECT_EQ(report().rate, 0.0);
}

TEST_F(RunFigures, InTheEndTheRateIsThatOfTheWholeRun) {
  hear(msg::STATE_FINISHED);
  processes_.stop = true;
  processes_.table.at(key_).running = false;
  processes_.phases["front"] = {ProcessPhase::finished, processes_.id(key_), 0};
  EXPECT_EQ(report().rate, 5.0);
  EXPECT_EQ(run_figures(record_, processes_, 4.0).duration, 4.0);
}

}  // namespace
}  // namespace quoin::deploy
