// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/changeover.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>

#include "deploy/orchestration/instruction.hpp"
#include "services/deployment/graph.hpp"
#include "tests/deploy/observation/pipeline.hpp"
#include "tests/deploy/orchestration/fakes.hpp"
#include "tests/deploy/orchestration/kind_fixtures.hpp"

namespace quoin::deploy {
namespace {

using msg::ControlAction;
using std::chrono::milliseconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;

Deployment chain(const std::string& method = "plain") {
  return deployment({service("front", lidar), service("fit", fitter, {{"scan", "front"}}),
                     service("map", mapper, {{"lines", "fit"}, {"odometry", "front"}}, method)});
}

/// Another QoS: the service and those who read it are replaced.
Deployment with_qos(Deployment deployment, const std::string& name) {
  for (ServiceConfig& each : deployment.services) {
    if (each.name == name) each.outputs.front().qos = "lossless";
  }
  return deployment;
}

/// A deployment that runs in a table, and services that answer at once: a held process has kept
/// scans from 7 on, its predecessor leaves those from 9 on and its state.
class ChangeoverTest : public testing::Test {
 protected:
  Changeover& begin(const Deployment& running, const Deployment& wanted) {
    running_ = running;
    wanted_ = wanted;
    for (const ProcessConfig& each : processes_of(running_)) {
      processes_.insert(process_plan(running_, each));
    }
    record_ = std::make_unique<DeploymentRecord>(running_, "", [](auto, const auto&) {});
    for (const auto& [key, process] : processes_.table) hear(key, msg::STATE_ACTIVE);
    plan_ = plan_changes(running_, wanted_);
    for (const ProcessConfig& each : processes_of(wanted_)) {
      plans_.push_back(process_plan(wanted_, each));
    }
    processes_.log = [this](const std::string& what) {
      if (!what.starts_with("replan ")) log_.push_back(what);
      everything_.push_back(what);
    };
    requester_.on_request = [this](const msg::ControlRequest& request) { answer(request); };
    dialogue_ = std::make_unique<Dialogue>(processes_, requester_, [this] { return pump(); });
    changeover_ = std::make_unique<Changeover>(
        Changeover::World{.processes = processes_,
                          .record = *record_,
                          .dialogue = *dialogue_,
                          .withdrawn = [this] { return withdrawn_; },
                          .last_line = [this](const std::string& name) { return lines_[name]; }},
        running_, wanted_, plan_, elsewhere_, plans_, milliseconds(10'000));
    return *changeover_;
  }

  static ProcessPlan process_plan(const Deployment& deployment, const ProcessConfig& process) {
    const ServiceConfig& first = *process.services.front();
    ProcessPlan plan{.name = process.name,
                     .program = "quoin-" + first.kind,
                     .arguments = {"--qos", first.outputs.empty() ? "" : first.outputs.front().qos,
                                   "--observers", "1"},
                     .level = Graph(deployment).level(process)};
    for (const ServiceConfig* each : process.services) plan.services.push_back(label(*each));
    return plan;
  }

  void hear(int key, msg::ServiceState state) {
    for (const std::string& service : processes_.table.at(key).plan.services) {
      msg::ServiceStatus status = heartbeat(service, incarnation(key), 0, state);
      status.pid(static_cast<std::uint32_t>(processes_.id(key)));
      status.detail(details_[status.service()]);
      record_->receive(status);
    }
  }
  static std::uint64_t incarnation(int key) { return static_cast<std::uint64_t>(50 + key); }

  bool pump() {
    requester_.wait_for_any(milliseconds(10));
    for (auto& [key, process] : processes_.table) {
      if (!process.trial || !process.running) continue;
      if (dying_.contains(process.plan.name)) {
        process.running = false;
        process.end = ProcessEnd{.by_signal = false, .value = 2};
        continue;
      }
      const bool held = process.plan.arguments.back() == "--held";
      const bool ready = !never_ready_.contains(process.plan.name);
      hear(key, !ready ? msg::STATE_STARTING : held ? msg::STATE_HELD : msg::STATE_ACTIVE);
    }
    return !processes_.stopping();
  }

  void answer(const msg::ControlRequest& request) {
    const std::string& name = request.service();
    msg::ControlReply reply;
    reply.accepted(true);
    msg::PortPosition position;
    switch (request.action()) {
      case ControlAction::CONTROL_SWAP_METHOD:
        log_.push_back("swap " + name + " to " + request.method());
        reply.first_sequence_number(31);
        break;
      case ControlAction::CONTROL_HOLD:
        log_.push_back("hold " + name);
        position.sequence_number(7);
        reply.positions({position});
        reply.held_scans(1);
        reply.first_sequence_number(7);
        break;
      case ControlAction::CONTROL_HAND_OVER:
        log_.push_back("hand over " + name);
        position.sequence_number(9);
        reply.positions({position});
        reply.state({1, 2});
        break;
      case ControlAction::CONTROL_TAKE_OVER:
        log_.push_back("take over " + name);
        if (forgotten_after_.contains(name)) processes_.forget(forgotten_after_.at(name));
        break;
      default:
        break;
    }
    const std::pair what(request.action(), name);
    if (silent_.contains(what)) return;
    if (refused_.contains(what)) {
      reply = {};
      reply.detail("cannot");
    } else if (request.action() == ControlAction::CONTROL_HAND_OVER) {
      leave(static_cast<int>(request.incarnation()) - 50);
    } else if (request.action() == ControlAction::CONTROL_STOP) {
      log_.push_back("ask " + name + " to stop");
      leave(static_cast<int>(request.incarnation()) - 50);
    }
    requester_.reply(request.request(), reply);
  }

  /// A process ends when all of its services have.
  void leave(int key) {
    FakeProcesses::Process& process = processes_.table.at(key);
    process.running = ++ended_[key] < process.plan.services.size();
  }

  [[nodiscard]] const msg::ControlRequest& request(ControlAction action,
                                                   const std::string& name) const {
    return *std::find_if(requester_.sent.begin(), requester_.sent.end(), [&](const auto& each) {
      return each.action() == action && each.service() == name;
    });
  }
  [[nodiscard]] std::vector<std::string> running_processes() const {
    std::vector<std::string> names;
    for (const auto& [key, process] : processes_.table) {
      if (process.running) names.push_back(process.plan.name);
    }
    return names;
  }
  [[nodiscard]] std::string failure_of_prepare() {
    try {
      changeover_->prepare();
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  Deployment running_;
  Deployment wanted_;
  Plan plan_;
  Plan elsewhere_;
  std::vector<ProcessPlan> plans_;
  FakeProcesses processes_;
  FakeRequester requester_;
  std::unique_ptr<DeploymentRecord> record_;
  std::unique_ptr<Dialogue> dialogue_;
  std::unique_ptr<Changeover> changeover_;
  std::vector<std::string> log_;                // all but the next
  std::vector<std::string> everything_;         // with other plans for processes that go on
  std::map<int, std::size_t> ended_;            // services, by key
  std::map<std::string, int> forgotten_after_;  // keys, by the service that takes over last
  std::map<std::string, std::string> lines_;
  std::map<std::string, std::string> details_;
  std::set<std::string> dying_;
  std::set<std::string> never_ready_;
  std::set<std::pair<ControlAction, std::string>> silent_;
  std::set<std::pair<ControlAction, std::string>> refused_;
  bool withdrawn_ = false;
};

TEST_F(ChangeoverTest, ASwapAsksTheRunningProcessAlone) {
  Changeover& changeover = begin(chain("plain"), chain("grid"));
  changeover.prepare();
  EXPECT_THAT(log_, ElementsAre("swap map to grid"));
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("swap map to grid"));
  EXPECT_THAT(changeover.first_scans(), ElementsAre(Pair("map", 31)));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
}

TEST_F(ChangeoverTest, ProcessesThatGoOnAreStartedAsWantedTheNextTime) {
  Changeover& changeover = begin(chain("plain"), with_qos(chain("plain"), "map"));
  changeover.prepare();
  EXPECT_THAT(everything_, Not(Contains(HasSubstr("replan"))));
  changeover.finish();
  EXPECT_THAT(everything_, Contains("replan fit"));
  EXPECT_THAT(everything_, Not(Contains("replan map")));
}

TEST_F(ChangeoverTest, AReplacementIsHeldUntilItsPredecessorHandsOver) {
  Changeover& changeover = begin(chain(), with_qos(chain(), "map"));
  changeover.prepare();
  EXPECT_THAT(log_, ElementsAre("start map"));
  EXPECT_THAT(processes_.table.at(4).plan.arguments,
              ElementsAre("--qos", "lossless", "--observers", "1", "--held"));
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("start map", "hold map", "retire map", "hand over map", "adopt map",
                                "take over map"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
  EXPECT_EQ(processes_.table.at(4).plan.arguments.back(), "1") << "started again it is not held";
}

TEST_F(ChangeoverTest, PositionsAndStateGoFromTheOldProcessToTheNew) {
  Changeover& changeover = begin(chain(), with_qos(chain(), "map"));
  changeover.prepare();
  changeover.finish();
  const msg::ControlRequest& leave = request(ControlAction::CONTROL_HAND_OVER, "map");
  EXPECT_EQ(leave.incarnation(), incarnation(3));
  ASSERT_EQ(leave.positions().size(), 1U);
  EXPECT_EQ(leave.positions()[0].sequence_number(), 7U) << "from where the new one has kept";
  const msg::ControlRequest& take = request(ControlAction::CONTROL_TAKE_OVER, "map");
  EXPECT_EQ(take.incarnation(), incarnation(4));
  ASSERT_EQ(take.positions().size(), 1U);
  EXPECT_EQ(take.positions()[0].sequence_number(), 9U) << "from where the old one has left";
  EXPECT_THAT(take.state(), ElementsAre(1, 2));
  EXPECT_THAT(changeover.first_scans(), ElementsAre(Pair("map", 9)));
}

TEST_F(ChangeoverTest, ScansOfAnotherSourceHaveNoCommonPosition) {
  Deployment two = chain();
  two.services.push_back(service("rear", lidar));
  Deployment wanted = two;
  wanted.services[1].inputs[0].service = "rear";
  Changeover& changeover = begin(two, wanted);
  ASSERT_FALSE(plan_.of("fit").same_scans);
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(request(ControlAction::CONTROL_HAND_OVER, "fit").positions(), IsEmpty());
  EXPECT_THAT(request(ControlAction::CONTROL_TAKE_OVER, "fit").positions(), IsEmpty());
  EXPECT_EQ(changeover.first_scans().at("fit"), 7U);
}

TEST_F(ChangeoverTest, ReplacementsTakeOverFromTheSourcesOn) {
  Changeover& changeover = begin(chain(), with_qos(chain(), "fit"));
  changeover.prepare();
  EXPECT_THAT(log_, ElementsAre("start fit", "start map"));
  log_.clear();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("hold fit", "hold map", "retire fit", "hand over fit", "adopt fit",
                                "take over fit", "retire map", "hand over map", "adopt map",
                                "take over map"));
}

Deployment in_process(Deployment deployment, const std::set<std::string>& names) {
  for (ServiceConfig& each : deployment.services) {
    if (names.contains(each.name)) each.process = "both";
  }
  return deployment;
}

TEST_F(ChangeoverTest, ServicesMoveIntoOneProcessOneAfterTheOther) {
  Changeover& changeover = begin(chain(), in_process(chain(), {"fit", "map"}));
  changeover.prepare();
  EXPECT_THAT(log_, ElementsAre("start both")) << "one process for both";
  log_.clear();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("hold fit", "hold map", "retire fit", "hand over fit", "adopt both",
                                "take over fit", "retire map", "hand over map", "adopt both",
                                "take over map"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "both"));
}

TEST_F(ChangeoverTest, AProcessGoesWhenTheLastOfItsServicesHasLeft) {
  Changeover& changeover = begin(in_process(chain(), {"fit", "map"}), chain());
  changeover.prepare();
  EXPECT_THAT(log_, ElementsAre("start fit", "start map"));
  log_.clear();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("hold fit", "hold map", "retire both", "hand over fit", "adopt fit",
                                "take over fit", "retire both", "hand over map", "adopt map",
                                "take over map"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
}

TEST_F(ChangeoverTest, AServiceThatIsRemovedFromAProcessIsAskedToStop) {
  Deployment wanted = chain();
  wanted.services.pop_back();
  Changeover& changeover = begin(in_process(chain(), {"fit", "map"}), in_process(wanted, {"fit"}));
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("start both", "hold fit", "retire both", "hand over fit",
                                "adopt both", "take over fit", "ask map to stop"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "both"));
}

TEST_F(ChangeoverTest, AProcessWithoutAServiceLeftIsStopped) {
  Deployment wanted = chain();
  wanted.services.resize(1);
  Changeover& changeover = begin(in_process(chain(), {"fit", "map"}), wanted);
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("stop both"));
  EXPECT_THAT(running_processes(), ElementsAre("front"));
}

TEST_F(ChangeoverTest, AProcessThatIsNotReadyIsStoppedOnce) {
  dying_ = {"both"};
  begin(chain(), in_process(chain(), {"fit", "map"}));
  EXPECT_THAT(failure_of_prepare(), HasSubstr("new process of service 'fit' ended"));
  EXPECT_THAT(log_, ElementsAre("start both", "stop both"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
}

TEST_F(ChangeoverTest, AReplacementWaitsForNewReadersBesideThoseThatGo) {
  Changeover& changeover = begin(chain(), with_qos(chain(), "fit"));
  changeover.prepare();
  EXPECT_THAT(
      processes_.table.at(4).plan.arguments,
      ElementsAre("--qos", "lossless", "--observers", "1", "--observers", "fit=1", "--held"))
      << "the map that goes reads the same topic";
}

TEST_F(ChangeoverTest, ReadersThatGoOnAnotherHostCountToo) {
  elsewhere_.changes.push_back({ChangeAction::stop, "map", ""});
  Changeover& changeover = begin(chain(), with_qos(chain(), "fit"));
  changeover.prepare();
  EXPECT_EQ(processes_.table.at(4).plan.arguments.at(5), "fit=2");
}

TEST_F(ChangeoverTest, NewReadersBeginBeforeTheSourceTheyRead) {
  Deployment wanted = chain();
  wanted.services.push_back(service("rear", lidar));
  wanted.services.push_back(service("fit_rear", fitter, {{"scan", "rear"}}));
  Changeover& changeover = begin(chain(), wanted);
  changeover.prepare();
  EXPECT_THAT(log_, ElementsAre("start rear", "start fit_rear"));
  log_.clear();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("hold fit_rear", "adopt fit_rear", "take over fit_rear",
                                "hold rear", "adopt rear", "take over rear"));
}

TEST_F(ChangeoverTest, RemovedServicesStopLastFromTheSourcesOn) {
  Deployment running = chain();
  running.services.push_back(service("extra", fitter, {{"scan", "front"}}));
  Deployment wanted = running;
  wanted.services.erase(wanted.services.begin() + 1, wanted.services.begin() + 3);
  wanted = with_qos(wanted, "extra");
  Changeover& changeover = begin(running, wanted);
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("start extra", "hold extra", "retire extra", "hand over extra",
                                "adopt extra", "take over extra", "stop fit", "stop map"));
  EXPECT_TRUE(record_->removed("map"));
}

TEST_F(ChangeoverTest, AServiceWhoseProcessIsDeadIsBegunAnew) {
  Changeover& changeover = begin(chain(), with_qos(chain(), "map"));
  processes_.table.at(3).running = false;
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(log_,
              ElementsAre("start map", "retire map", "hold map", "adopt map", "take over map"))
      << "retired, or it would be started again beside its successor";
}

TEST_F(ChangeoverTest, AProcessThatDiesBetweenItsServicesHoldsNothingUp) {
  Changeover& changeover = begin(in_process(chain(), {"fit", "map"}), chain());
  changeover.prepare();
  log_.clear();
  forgotten_after_["fit"] = processes_.key_of("fit").value();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("hold fit", "hold map", "retire both", "hand over fit", "adopt fit",
                                "take over fit", "hold map", "adopt map", "take over map"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
}

TEST_F(ChangeoverTest, ARefusedSwapUndoesThoseBefore) {
  Deployment running = chain("plain");
  running.services.push_back(service("grid", mapper, {{"lines", "fit"}}, "plain"));
  Deployment wanted = chain("grid");
  wanted.services.push_back(service("grid", mapper, {{"lines", "fit"}}, "lines"));
  refused_ = {{ControlAction::CONTROL_SWAP_METHOD, "grid"}};
  begin(running, wanted);
  EXPECT_THAT(failure_of_prepare(), HasSubstr("'grid'"));
  EXPECT_THAT(log_, ElementsAre("swap map to grid", "swap grid to lines", "swap map to plain"));
  EXPECT_THAT(changeover_->first_scans(), IsEmpty());
}

TEST_F(ChangeoverTest, ANewProcessThatEndsLeavesEverythingAsItWas) {
  Deployment wanted = with_qos(chain(), "map");
  wanted.services.push_back(service("extra", fitter, {{"scan", "front"}}));
  dying_ = {"extra"};
  lines_ = {{"extra", "12:00:00.000 [extra] error: no such port"}};
  begin(chain(), wanted);
  const std::string failure = failure_of_prepare();
  EXPECT_THAT(failure, HasSubstr("'extra' ended with exit code 2"));
  EXPECT_THAT(failure, HasSubstr(": no such port"));
  EXPECT_THAT(log_, ElementsAre("start map", "start extra", "stop map", "stop extra"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
  EXPECT_FALSE(record_->process("map", processes_.id(4)).has_value());
  EXPECT_FALSE(record_->knows("extra"));
}

TEST_F(ChangeoverTest, NothingIsSwappedBeforeNewProcessesAreReady) {
  Deployment wanted = chain("grid");
  wanted.services.push_back(service("extra", fitter, {{"scan", "front"}}));
  never_ready_ = {"extra"};
  details_ = {{"extra", "waiting for 1 reader"}};
  begin(chain("plain"), wanted);
  const std::string failure = failure_of_prepare();
  EXPECT_THAT(failure, HasSubstr("'extra' was not ready within 10.0 s"));
  EXPECT_THAT(failure, HasSubstr("waiting for 1 reader"));
  EXPECT_THAT(log_, ElementsAre("start extra", "stop extra"));
}

TEST_F(ChangeoverTest, APredecessorThatDoesNotAnswerIsNotReplaced) {
  silent_ = {{ControlAction::CONTROL_DESCRIBE, "fit"}};
  Deployment wanted = chain();
  wanted.services[1].outputs[0].topic = "elsewhere";
  wanted.services[1].program = {"other"};
  begin(chain(), wanted);
  EXPECT_NE(failure_of_prepare(), "");
  EXPECT_THAT(log_, Not(Contains("retire fit")));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
}

TEST_F(ChangeoverTest, WithdrawnInTimeItLeavesEverythingAsItWas) {
  withdrawn_ = true;
  never_ready_ = {"map"};
  begin(chain(), with_qos(chain(), "map"));
  EXPECT_EQ(failure_of_prepare(), withdrawn);
  EXPECT_THAT(log_, ElementsAre("start map", "stop map"));
}

TEST_F(ChangeoverTest, ADeploymentThatStopsIsNotChanged) {
  processes_.stop = true;
  never_ready_ = {"map"};
  begin(chain(), with_qos(chain(), "map"));
  EXPECT_EQ(failure_of_prepare(), "the deployment is stopping");
  EXPECT_THAT(log_, ElementsAre("start map", "stop map"));
}

TEST_F(ChangeoverTest, ReadyItCanStillBeUndone) {
  Changeover& changeover = begin(chain("plain"), with_qos(chain("plain"), "map"));
  changeover.prepare();
  changeover.roll_back();
  EXPECT_THAT(log_, ElementsAre("start map", "stop map"));
  EXPECT_THAT(changeover.first_scans(), IsEmpty());
}

TEST_F(ChangeoverTest, AProgramThatCannotBeHeldIsStoppedFirst) {
  const auto camera = [](const std::string& option) {
    return deployment({stranger("camera", "rt/scan", "best_effort", {"/opt/camera", option}),
                       service("fit", fitter, {{"scan", "camera"}})});
  };
  Changeover& changeover = begin(camera("--slow"), camera("--fast"));
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("stop camera", "start camera", "adopt camera"));
}

TEST_F(ChangeoverTest, AProgramThatWasStoppedFirstIsStartedAgainWhenTheRestFails) {
  const auto camera = [](const std::string& option) {
    return deployment({stranger("camera", "rt/scan", "best_effort", {"/opt/camera", option}),
                       service("fit", fitter, {{"scan", "camera"}})});
  };
  begin(camera("--slow"), camera("--fast"));
  dying_ = {"camera"};
  processes_.table.at(1).plan.arguments = {"--slow"};
  withdrawn_ = true;
  EXPECT_NE(failure_of_prepare(), "");
  EXPECT_THAT(log_, ElementsAre("stop camera", "start camera", "stop camera", "start camera",
                                "adopt camera"));
  EXPECT_THAT(processes_.table.at(4).plan.arguments, ElementsAre("--slow"));
}

TEST_F(ChangeoverTest, APredecessorThatDoesNotHandOverIsKilled) {
  silent_ = {{ControlAction::CONTROL_HAND_OVER, "map"}};
  Changeover& changeover = begin(chain(), with_qos(chain(), "map"));
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("start map", "hold map", "retire map", "hand over map", "kill map",
                                "adopt map", "take over map"));
  const msg::ControlRequest& take = request(ControlAction::CONTROL_TAKE_OVER, "map");
  EXPECT_THAT(take.positions(), IsEmpty()) << "everything that is held";
  EXPECT_THAT(take.state(), IsEmpty());
  EXPECT_EQ(changeover.first_scans().at("map"), 7U);
}

TEST_F(ChangeoverTest, APredecessorThatRefusesToHandOverIsKilled) {
  refused_ = {{ControlAction::CONTROL_HAND_OVER, "map"}};
  Changeover& changeover = begin(chain(), with_qos(chain(), "map"));
  changeover.prepare();
  changeover.finish();
  EXPECT_THAT(log_, Contains("kill map"));
  EXPECT_THAT(running_processes(), ElementsAre("front", "fit", "map"));
}

TEST_F(ChangeoverTest, AProcessThatFailsInTheMiddleDoesNotHoldUpTheOthers) {
  silent_ = {{ControlAction::CONTROL_TAKE_OVER, "fit"}};
  Changeover& changeover = begin(chain(), with_qos(chain(), "fit"));
  changeover.prepare();
  log_.clear();
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("hold fit", "hold map", "retire fit", "hand over fit", "adopt fit",
                                "take over fit", "kill fit", "retire map", "hand over map",
                                "adopt map", "take over map"))
      << "the killed process is started again";
}

TEST_F(ChangeoverTest, AProcessThatRefusesToTakeOverIsKilled) {
  refused_ = {{ControlAction::CONTROL_TAKE_OVER, "map"}};
  Changeover& changeover = begin(chain(), with_qos(chain(), "map"));
  changeover.prepare();
  changeover.finish();
  EXPECT_EQ(log_.back(), "kill map") << "held it would do nothing for ever";
}

TEST_F(ChangeoverTest, OneChangeAfterTheOtherIsDoneOnce) {
  Deployment wanted = with_qos(chain(), "map");
  wanted.services.push_back(service("extra", fitter, {{"scan", "front"}}));
  Changeover& changeover = begin(chain(), wanted);
  changeover.prepare();
  log_.clear();
  changeover.change("extra");
  EXPECT_THAT(log_, ElementsAre("hold extra", "adopt extra", "take over extra"));
  changeover.change("extra");
  changeover.change("nobody");
  EXPECT_EQ(log_.size(), 3U);
  changeover.change("map");
  const std::size_t all = log_.size();
  changeover.finish();
  EXPECT_EQ(log_.size(), all);
}

TEST_F(ChangeoverTest, AServiceThatMovesToAnotherHostStopsWhenItIsTold) {
  Deployment wanted = chain();
  wanted.services.pop_back();
  Changeover& changeover = begin(chain(), wanted);
  changeover.prepare();
  changeover.change("map");
  EXPECT_THAT(log_, ElementsAre("stop map"));
  changeover.finish();
  EXPECT_THAT(log_, ElementsAre("stop map"));
}

}  // namespace
}  // namespace quoin::deploy
