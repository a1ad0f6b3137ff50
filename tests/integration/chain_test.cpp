// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <idl/Lines.h>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/simulation/world.hpp"
#include "sensor_bridge/message_files/mcap_reader.hpp"
#include "services/topics/cdr_codec.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using tests::CornerRecorder;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

const char* const three_fitters = R"(
  - {name: front, kind: simulated, parameters: {environment: domestic_room, rate_hz: 50, scans: 200}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: utls, kind: line_fitting, input: walls, method: utls}
  - {name: wtls, kind: line_fitting, input: walls, method: wtls}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: utls_corners, kind: corner_estimation, input: utls, method: adjacent}
  - {name: wtls_corners, kind: corner_estimation, input: wtls, method: adjacent}
  - {name: wctls_corners, kind: corner_estimation, input: wctls, method: adjacent}
)";

/// Squared Mahalanobis distance from a corner to the nearest true one.
double nearest_truth(const msg::Corner& corner, const std::vector<Eigen::Vector2d>& truth) {
  Eigen::Matrix2d covariance;
  covariance << corner.covariance_xx(), corner.covariance_xy(), corner.covariance_xy(),
      corner.covariance_yy();
  const Eigen::Matrix2d information = covariance.inverse();
  double nearest = INFINITY;
  for (const Eigen::Vector2d& position : truth) {
    const Eigen::Vector2d error = Eigen::Vector2d(corner.x(), corner.y()) - position;
    nearest = std::min(nearest, error.dot(information * error));
  }
  return nearest;
}

std::vector<Eigen::Vector2d> true_corners(const std::string& world_name) {
  const World world = *built_in_world(world_name);
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& corner : world.corners()) {
    corners.push_back(world.path.front().inverse_transform(corner));
  }
  return corners;
}

TEST(Chain, DeliversAll200ScansThroughThreeFittersWithTrueCorners) {
  const TestDeployment deployment(three_fitters);
  runtime::Participant participant(deployment.participant("test"));
  const std::vector<std::string> names{"utls_corners", "wtls_corners", "wctls_corners"};
  std::vector<std::unique_ptr<CornerRecorder>> recorders;
  for (const std::string& name : names) {
    recorders.push_back(std::make_unique<CornerRecorder>(participant, deployment, name));
  }
  StatusRecorder status(participant, deployment);
  std::vector<Process> processes;
  for (const auto& service : deployment.deployment().services) {
    const bool last = service.kind == "corner_estimation";
    processes.push_back(deployment.start(service.name, last ? 1 : 0));
  }
  for (auto& recorder : recorders) {
    EXPECT_TRUE(tests::eventually(
        [&] {
          for (auto& each : recorders) each->poll();
          return recorder->messages().size() >= 200;
        },
        60s));
  }

  const auto truth = true_corners("domestic_room");
  for (std::size_t i = 0; i < names.size(); ++i) {
    SCOPED_TRACE(names[i]);
    const CornerRecorder& recorder = *recorders[i];
    EXPECT_EQ(recorder.messages().size(), 200U);
    EXPECT_THAT(recorder.accounting().lost_by_site(), testing::IsEmpty());
    EXPECT_EQ(recorder.accounting().duplicates(), 0U);
    EXPECT_EQ(recorder.accounting().first_sequence(), 0U);
    std::size_t corners = 0;
    std::size_t within = 0;
    for (const msg::Corners& message : recorder.messages()) {
      for (const msg::Corner& corner : message.corners()) {
        ++corners;
        if (nearest_truth(corner, truth) <= 16.0) ++within;
      }
    }
    EXPECT_GE(corners, 200U * 4U) << "a room has at least four corners";
    EXPECT_GE(static_cast<double>(within), 0.99 * static_cast<double>(corners));
  }

  // The trace names every stage, in order, with times that do not run backwards.
  const msg::Header& header = recorders[2]->messages().back().header();
  ASSERT_EQ(header.trace().size(), 4U);
  const std::vector<std::string> stages{"front", "walls", "wctls", "wctls_corners"};
  std::int64_t before = header.stamp();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    EXPECT_EQ(header.trace()[i].service(), stages[i]);
    EXPECT_EQ(header.trace()[i].index(), 199U);
    EXPECT_LE(before, header.trace()[i].received());
    EXPECT_LE(header.trace()[i].received(), header.trace()[i].published());
    before = header.trace()[i].published();
  }
  EXPECT_EQ(header.trace()[1].method(), "iepf");

  // Everybody's own books agree.
  for (const auto& service : deployment.deployment().services) {
    SCOPED_TRACE(service.name);
    EXPECT_TRUE(status.wait_for(service.name, [](const auto& s) { return s.published() == 200; }));
    EXPECT_EQ(status.latest(service.name).lost(), 0U);
    EXPECT_EQ(status.latest(service.name).upstream_lost(), 0U);
    if (service.kind != "simulated") {
      EXPECT_EQ(status.latest(service.name).received(), 200U);
    }
  }
  EXPECT_EQ(processes[0].wait(10s), 0) << "the source ends by itself: " << processes[0].errors();
  for (std::size_t i = 1; i < processes.size(); ++i) {
    processes[i].signal(SIGTERM);
    EXPECT_EQ(processes[i].wait(10s), 0) << processes[i].errors();
  }
}

const char* const one_fitter = R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 50}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)";

std::vector<Process> start_all(const TestDeployment& deployment) {
  std::vector<Process> processes;
  for (const auto& service : deployment.deployment().services) {
    processes.push_back(deployment.start(service.name));
  }
  return processes;
}

TEST(Chain, ALateReaderGetsEveryScanFromThenOn) {
  const TestDeployment deployment(one_fitter);
  runtime::Participant early_participant(deployment.participant("early"));
  CornerRecorder early(early_participant, deployment, "corners");
  const auto processes = start_all(deployment);
  ASSERT_TRUE(early.wait_for(50));

  runtime::Participant late_participant(deployment.participant("late"));
  CornerRecorder late(late_participant, deployment, "corners");
  ASSERT_TRUE(tests::eventually([&] {
    early.poll();  // keeps taking, else its own history overflows
    return late.poll() >= 50;
  }));
  EXPECT_GE(*late.accounting().first_sequence(), 50U);
  // What a stage did not get in time on a busy machine, it did not publish.
  EXPECT_EQ(late.accounting().lost_by_site().count({runtime::LossPlace::link}), 0U);
  EXPECT_EQ(early.accounting().lost_by_site().count({runtime::LossPlace::link}), 0U);
}

TEST(Chain, ALateFitterJoinsTheRunningChain) {
  const TestDeployment deployment(
      std::string(one_fitter) +
      "  - {name: utls, kind: line_fitting, input: walls, method: utls}\n"
      "  - {name: utls_corners, kind: corner_estimation, input: utls}\n");
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder first(participant, deployment, "corners");
  CornerRecorder second(participant, deployment, "utls_corners");
  std::vector<Process> processes;
  for (const char* name : {"front", "walls", "wctls", "corners"})
    processes.push_back(deployment.start(name));
  // walls waits for both fitters, but not for ever.
  ASSERT_TRUE(first.wait_for(20, 40s));
  processes.push_back(deployment.start("utls"));
  processes.push_back(deployment.start("utls_corners"));
  ASSERT_TRUE(tests::eventually(
      [&] {
        first.poll();
        return second.poll() >= 50;
      },
      40s));
  EXPECT_GT(*second.accounting().first_sequence(), 0U);
  EXPECT_THAT(second.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_THAT(first.accounting().lost_by_site(), testing::IsEmpty());
}

/// Messages of one topic of a recording by the stamp of their scan, without what says how they
/// came.
std::map<std::int64_t, msg::Lines> recorded_lines(const std::filesystem::path& file,
                                                  const std::string& topic) {
  sensor_bridge::mcap::Reader reader(file);
  sensor_bridge::mcap::RecordedMessage message;
  std::map<std::int64_t, msg::Lines> result;
  while (reader.next(message)) {
    if (message.channel->topic != topic) continue;
    msg::Lines lines;
    const auto* bytes = reinterpret_cast<const std::byte*>(message.data.data());
    EXPECT_TRUE(
        topics::decode(topics::cdr_codec<msg::Lines>(), bytes, message.data.size(), &lines));
    const std::int64_t stamp = lines.header().stamp();
    lines.header().origins().clear();
    lines.header().trace().clear();
    result[stamp] = std::move(lines);
  }
  return result;
}

TEST(Chain, StagesOfARecordingGiveTheSameResultsBitForBit) {
  const TestDeployment recorded(
      "  - {name: front, kind: simulated, parameters: {environment: domestic_room, rate_hz: 50, "
      "scans: 60}}\n"
      "  - {name: walls, kind: segmentation, input: front}\n"
      "  - {name: fit, kind: line_fitting, input: walls}\n"
      "  - {name: tape, kind: recorder, inputs: all, parameters: {path: run.mcap}}\n",
      "qos: lossless\n");
  Process run = recorded.quoin({"up", "FILE", "--quiet"});
  ASSERT_EQ(run.wait(60s), 0) << run.errors();
  const auto file = recorded.directory().path() / "run.mcap";
  const auto expected = recorded_lines(file, recorded.topic("fit"));
  ASSERT_EQ(expected.size(), 60U);

  for (const char* stage : {"scan", "segments"}) {
    const bool from_scans = std::string(stage) == "scan";
    const TestDeployment replayed(
        "  - {name: run, kind: replay, parameters: {path: " + file.string() +
            ", messages: " + stage + ", stamps: recorded, speed: 0}}\n" +
            (from_scans ? "  - {name: walls, kind: segmentation, input: run}\n" : "") +
            "  - {name: fit, kind: line_fitting, input: " + (from_scans ? "walls" : "run") +
            "}\n"
            "  - {name: tape, kind: recorder, inputs: all, parameters: {path: again.mcap}}\n",
        "qos: lossless\n", "quoin", std::string("_") + stage);
    Process again = replayed.quoin({"up", "FILE", "--quiet"});
    ASSERT_EQ(again.wait(60s), 0) << again.errors();
    EXPECT_EQ(recorded_lines(replayed.directory().path() / "again.mcap", replayed.topic("fit")),
              expected)
        << "from " << stage;
  }
}

}  // namespace
}  // namespace quoin
