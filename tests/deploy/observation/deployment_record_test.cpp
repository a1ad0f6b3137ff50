// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/deployment_record.hpp"

#include <algorithm>
#include <stdexcept>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "deploy/observation/summary.hpp"
#include "tests/deploy/observation/pipeline.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// front -> fit -> map, whose corners nobody reads.
Deployment chain() {
  return deployment({service("front", lidar), service("fit", fitter, {{"scan", "front"}}),
                     service("map", mapper, {{"lines", "fit"}, {"odometry", "front"}}, "plain")});
}

const KindInfo camera{
    .name = "camera", .description = "", .program = "launch_test", .outputs = {{"scan"}}};

/// camera -> fit@2, fit@1: the stronger is heard.
Deployment standby() {
  Deployment two =
      deployment({service("camera", camera), service("fit", fitter, {{"scan", "camera"}}),
                  service("fit", fitter, {{"scan", "camera"}})});
  two.services[1].strength = 2;
  two.services[2].strength = 1;
  return two;
}

class Record : public testing::Test {
 protected:
  DeploymentRecord& start(const Deployment& deployment, const std::string& host = "") {
    record_.emplace(deployment, host, [this](std::size_t end, const Connection& connection) {
      if (refuse_ends_) throw std::runtime_error("DDS refuses");
      ends_.emplace_back(end, connection.output.topic);
    });
    return *record_;
  }
  [[nodiscard]] ServiceFigures figures(const std::string& name) const {
    const DeploymentFigures all = record_->figures();
    return *std::ranges::find(all.services, name, &ServiceFigures::name);
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const ServiceFigures& each : record_->figures().services) names.push_back(each.name);
    return names;
  }

  std::optional<DeploymentRecord> record_;
  std::vector<std::pair<std::size_t, std::string>> ends_;  // told to listen to
  bool refuse_ends_ = false;
  Pipeline pipeline_{{"front", "fit", "map"}};
};

TEST_F(Record, ListensToWhatNoServiceReads) {
  start(chain());
  EXPECT_THAT(ends_, ElementsAre(Pair(0, "robot/map/corners")));
}

TEST_F(Record, ListensToTheEndsOfItsHostAlone) {
  Deployment two_hosts = chain();
  for (ServiceConfig& each : two_hosts.services) each.host = each.name == "map" ? "base" : "cabin";
  start(two_hosts, "cabin");
  EXPECT_THAT(ends_, IsEmpty());
  EXPECT_THAT(names(), ElementsAre("front", "fit"));
}

TEST_F(Record, ShowsWhatAHeartbeatSays) {
  DeploymentRecord& record = start(chain());
  msg::ServiceStatus status = heartbeat("map", 13, 40);
  status.method("grid");
  status.rate(9.5);
  status.failures(2);
  record.receive(status);
  const ServiceFigures map = figures("map");
  EXPECT_EQ(map.kind, "mapper");
  EXPECT_EQ(map.method, "grid");
  EXPECT_EQ(map.report.state, "active");
  EXPECT_EQ(map.report.rate, 9.5);
  EXPECT_EQ(map.report.published, 40U);
  EXPECT_EQ(map.report.failures, 2U);
}

TEST_F(Record, BeforeTheFirstHeartbeatShowsWhatTheFileSays) {
  start(chain());
  EXPECT_EQ(figures("map").method, "plain");
  EXPECT_EQ(figures("map").report.state, "");
  EXPECT_FALSE(record_->process("map", 113).has_value());
}

TEST_F(Record, SumsCountersOverRestarts) {
  DeploymentRecord& record = start(chain());
  record.receive(heartbeat("fit", 12, 5));
  msg::ServiceStatus newest = heartbeat("fit", 22, 7);
  newest.rate(10.0);
  record.receive(newest);
  EXPECT_EQ(figures("fit").report.published, 12U);
  EXPECT_EQ(figures("fit").report.rate, 10.0);
}

TEST_F(Record, ALateHeartbeatOfAnOlderProcessChangesCountersAlone) {
  DeploymentRecord& record = start(chain());
  msg::ServiceStatus newest = heartbeat("map", 23, 4);
  newest.method("grid");
  record.receive(newest);
  msg::ServiceStatus late = heartbeat("map", 13, 50, msg::STATE_STOPPED);
  late.method("plain");
  record.receive(late);
  EXPECT_EQ(figures("map").method, "grid");
  EXPECT_EQ(figures("map").report.state, "active");
  EXPECT_EQ(figures("map").report.published, 54U);
}

TEST_F(Record, AHeldProcessDoesNotHideTheOneAtWork) {
  DeploymentRecord& record = start(chain());
  msg::ServiceStatus at_work = heartbeat("map", 13, 40);
  at_work.method("plain");
  at_work.rate(10.0);
  record.receive(at_work);
  msg::ServiceStatus held = heartbeat("map", 23, 0, msg::STATE_HELD);
  held.method("grid");
  record.receive(held);
  EXPECT_EQ(figures("map").report.state, "active");
  EXPECT_EQ(figures("map").report.rate, 10.0);
  EXPECT_EQ(figures("map").method, "plain");
  EXPECT_EQ(record.process("map", 123)->state, msg::STATE_HELD);
}

TEST_F(Record, IgnoresServicesThatItDoesNotKnow) {
  DeploymentRecord& record = start(chain());
  record.receive(heartbeat("stranger", 9, 100));
  EXPECT_FALSE(record.knows("stranger"));
  EXPECT_FALSE(record.was_active("stranger"));
  EXPECT_THAT(names(), ElementsAre("front", "fit", "map"));
}

TEST_F(Record, ScansOfAnUnknownSourceAreDeliveredButNotPublished) {
  DeploymentRecord& record = start(chain());
  Pipeline other({"stranger", "fit", "map"});
  record.receive(0, other.scan());
  record.receive(0, other.scan());
  EXPECT_EQ(record.figures().scans_published, 0U);
  EXPECT_EQ(record.figures().ends.at(0).scans_delivered, 2U);
}

TEST_F(Record, ATraceShowsWhatAKilledProcessHadPublished) {
  DeploymentRecord& record = start(chain());
  record.receive(heartbeat("front", 11, 6));
  record.receive(heartbeat("fit", 12, 6));
  for (int i = 0; i < 10; ++i) record.receive(0, pipeline_.scan());
  EXPECT_EQ(record.figures().scans_published, 10U);
  EXPECT_EQ(figures("front").report.published, 10U);
  EXPECT_EQ(figures("fit").report.published, 10U);
  EXPECT_EQ(figures("fit").report.received, 10U);
  EXPECT_THAT(figures("front").numbered, Contains(Pair("scan", 10)));
}

TEST_F(Record, PutsLossesToTheirStages) {
  DeploymentRecord& record = start(chain());
  record.receive(0, pipeline_.scan());
  (void)pipeline_.scan(1);
  (void)pipeline_.scan(2);
  record.receive(0, pipeline_.scan());
  record.receive(heartbeat("front", 11, 4, msg::STATE_FINISHED));
  record.close();
  const EndFigures end = record.figures().ends.at(0);
  EXPECT_THAT(end.lost.by_service, ElementsAre(Pair("fit", 1), Pair("map", 1)));
  EXPECT_EQ(end.scans_expected, 4U);
  EXPECT_EQ(end.scans_delivered, 2U);
}

TEST_F(Record, ScansBehindTheLastThatArrivedAreLostOnceItIsClosed) {
  DeploymentRecord& record = start(chain());
  for (int i = 0; i < 3; ++i) record.receive(0, pipeline_.scan());
  record.receive(heartbeat("front", 11, 5, msg::STATE_FINISHED));
  EXPECT_EQ(record.figures().ends.at(0).lost.sum(), 0U);
  record.close();
  EXPECT_EQ(record.figures().ends.at(0).lost.at_end, 2U);
}

TEST_F(Record, ASourceElsewhereGoesOnWithoutUs) {
  Deployment two_hosts = chain();
  for (ServiceConfig& each : two_hosts.services) {
    each.host = each.name == "front" ? "base" : "cabin";
  }
  DeploymentRecord& record = start(two_hosts, "cabin");
  record.receive(heartbeat("front", 11, 1));
  for (int i = 0; i < 3; ++i) record.receive(0, pipeline_.scan());
  record.receive(heartbeat("front", 11, 9));
  record.close();
  EXPECT_EQ(record.figures().ends.at(0).scans_expected, 3U);
  EXPECT_EQ(record.figures().scans_published, 9U);
}

TEST_F(Record, InstancesOfOneNameAreToldApartByTheirProcesses) {
  DeploymentRecord& record = start(standby());
  record.receive(heartbeat("fit@2", 12, 3));
  record.receive(heartbeat("fit@1", 32, 3));
  Pipeline by_the_strong({"camera", "fit"});
  for (int i = 0; i < 5; ++i) record.receive(0, by_the_strong.scan());
  EXPECT_EQ(figures("fit@2").report.published, 5U);
  EXPECT_EQ(figures("fit@1").report.published, 3U);
  by_the_strong.restart(1, 32);  // now by the weak one
  record.receive(0, by_the_strong.scan());
  EXPECT_EQ(figures("fit@2").report.published, 5U);
  EXPECT_THAT(names(), ElementsAre("camera", "fit@2", "fit@1"));
}

TEST_F(Record, AProcessOfOneOfSeveralInstancesIsNobodysBeforeItsHeartbeat) {
  DeploymentRecord& record = start(standby());
  Pipeline pipeline({"camera", "fit"});
  record.receive(0, pipeline.scan());
  EXPECT_EQ(figures("fit@2").report.published, 0U);
  EXPECT_EQ(figures("fit@1").report.published, 0U);
  EXPECT_EQ(record.figures().ends.at(0).scans_delivered, 1U);
}

TEST_F(Record, NamesThoseThatWereNeverActiveAndWhy) {
  DeploymentRecord& record = start(chain());
  msg::ServiceStatus waiting = heartbeat("fit", 12, 0, msg::STATE_STARTING);
  waiting.detail("waiting for 1 reader");
  record.receive(waiting);
  record.receive(heartbeat("front", 11));
  EXPECT_EQ(record.never_active(), "fit (waiting for 1 reader), map");
  record.receive(heartbeat("fit", 12));
  record.receive(heartbeat("map", 13, 0, msg::STATE_HELD));
  EXPECT_FALSE(record.all_were_active());
  record.receive(heartbeat("map", 13));
  EXPECT_TRUE(record.all_were_active());
  record.receive(heartbeat("map", 23, 0, msg::STATE_STARTING));
  EXPECT_TRUE(record.was_active("map")) << "though it was started again";
}

TEST_F(Record, AServiceHasEndedWhenItsNewestProcessHas) {
  DeploymentRecord& record = start(chain());
  EXPECT_FALSE(record.have_ended({"fit"}));
  record.receive(heartbeat("fit", 12, 5, msg::STATE_FAILED));
  EXPECT_TRUE(record.have_ended({"fit"}));
  record.receive(heartbeat("fit", 22, 0));
  EXPECT_FALSE(record.have_ended({"fit"}));
  record.receive(heartbeat("fit", 22, 9, msg::STATE_STOPPED));
  EXPECT_TRUE(record.have_ended({"fit"}));
  EXPECT_FALSE(record.have_ended({"fit", "map"}));
}

TEST_F(Record, ListsTheProcessesThatReport) {
  DeploymentRecord& record = start(chain());
  record.receive(heartbeat("fit", 12));
  record.receive(heartbeat("fit", 22));
  EXPECT_THAT(record.processes(), ElementsAre(Pair("fit", ElementsAre(112, 122))));
}

TEST_F(Record, AForgottenProcessWasNeverThere) {
  DeploymentRecord& record = start(chain());
  record.receive(heartbeat("fit", 12, 5));
  record.receive(heartbeat("fit", 22, 9));
  record.forget("fit", 122);
  record.receive(heartbeat("fit", 22, 9, msg::STATE_STOPPED));
  EXPECT_EQ(figures("fit").report.published, 5U);
  EXPECT_FALSE(record.process("fit", 122).has_value());
}

TEST_F(Record, AnotherProcessMayGetTheIdOfAForgottenOne) {
  DeploymentRecord& record = start(chain());
  record.forget("fit", 122);
  msg::ServiceStatus later = heartbeat("fit", std::uint64_t{1} << 63, 4);
  later.pid(122);
  record.receive(later);
  EXPECT_EQ(figures("fit").report.published, 4U);
}

TEST_F(Record, KeepsRemovedServicesLast) {
  DeploymentRecord& record = start(chain());
  record.receive(heartbeat("fit", 12, 5));
  record.confirm(deployment({service("front", lidar)}));
  EXPECT_TRUE(record.removed("fit"));
  EXPECT_FALSE(record.removed("front"));
  EXPECT_THAT(names(), ElementsAre("front", "fit", "map"));
  EXPECT_EQ(figures("fit").report.published, 5U);
  EXPECT_EQ(record.never_active(), "front") << "nobody waits for the others";
}

TEST_F(Record, ForgetsWhatWasAddedInVain) {
  DeploymentRecord& record = start(deployment({service("front", lidar)}));
  record.add(chain());
  EXPECT_TRUE(record.knows("fit"));
  EXPECT_THAT(names(), ElementsAre("front")) << "not confirmed yet";
  record.confirm(deployment({service("front", lidar)}));
  EXPECT_FALSE(record.knows("fit"));
}

TEST_F(Record, OfAnEndThatIsAddedLaterEarlierScansAreForNobody) {
  DeploymentRecord& record = start(deployment({service("front", lidar)}));
  record.add(chain());
  record.confirm(chain());
  ASSERT_EQ(ends_.back().second, "robot/map/corners");
  record.receive(heartbeat("front", 11, 5));
  for (int i = 0; i < 4; ++i) (void)pipeline_.scan(1);
  record.receive(ends_.back().first, pipeline_.scan());
  const auto ends = record.figures().ends;
  EXPECT_EQ(std::ranges::find(ends, "map", &EndFigures::name)->scans_expected, 1U);
}

TEST_F(Record, AnEndThatCannotBeListenedToIsTriedAgain) {
  DeploymentRecord& record = start(deployment({service("front", lidar)}));
  const std::size_t before = ends_.size();
  refuse_ends_ = true;
  EXPECT_THROW(record.add(chain()), std::runtime_error);
  record.confirm(deployment({service("front", lidar)}));
  refuse_ends_ = false;
  record.add(chain());
  ASSERT_EQ(ends_.size(), before + 1);
  EXPECT_EQ(ends_.back().second, "robot/map/corners");
}

TEST_F(Record, OutputsAtTheirOwnRateAreNumberedApart) {
  DeploymentRecord& record = start(chain());
  msg::ServiceStatus status = heartbeat("front", 11, 50);
  msg::OutputStatus segments;
  segments.topic("robot/front/segments");
  segments.published(5);
  status.outputs().push_back(segments);
  record.receive(status);
  EXPECT_THAT(figures("front").numbered, ElementsAre(Pair("scan", 50), Pair("segments", 5)));
  EXPECT_EQ(record.figures().scans_published, 50U);
}

TEST_F(Record, ItsFiguresAreTheSummary) {
  DeploymentRecord& record = start(chain());
  record.receive(heartbeat("front", 11, 3));
  for (int i = 0; i < 3; ++i) record.receive(0, pipeline_.scan());
  const auto json = summary(record.figures());
  EXPECT_EQ(json.at("deployment"), "/robots/robot.yaml");
  EXPECT_EQ(json.at("scans_published"), 3);
  EXPECT_EQ(json.at("services").size(), 3U);
}

}  // namespace
}  // namespace quoin::deploy
