// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Quoin as seen by a program of another DDS: tests/interoperability, in C with Cyclone DDS, with
// types made of our IDL files by Cyclone's own compiler. It knows nothing of Quoin's code.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sensor_bridge/recordings/scan_files.hpp"
#include "services/topics/header.hpp"
#include "services/topics/message_json.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using tests::Process;
using tests::Recorder;
using tests::TestDeployment;

class Interoperability : public testing::Test {
 protected:
  void SetUp() override {
    const std::string configuration = QUOIN_CYCLONE_CONFIGURATION;  // empty when it is not there
    if (configuration.empty()) {
      GTEST_SKIP() << "built without Cyclone DDS; tests/packages.txt names its packages";
    }
    setenv("CYCLONEDDS_URI", ("file://" + configuration).c_str(), 1);
  }
};

/// What the Cyclone program printed, by topic.
std::map<std::string, std::vector<json>> messages_of(const Process& program) {
  std::map<std::string, std::vector<json>> messages;
  std::istringstream lines(program.output());
  std::string line;
  // The last line may still be on its way.
  while (std::getline(lines, line) && !lines.eof()) {
    json printed = json::parse(line);
    messages[printed.at("topic")].push_back(std::move(printed.at("message")));
  }
  return messages;
}

template <class T>
void expect_same(const std::vector<json>& theirs, const std::vector<T>& ours) {
  ASSERT_EQ(theirs.size(), ours.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_EQ(topics::sequence_number(ours[i].header()), i);
    const json expected = topics::to_json(ours[i]);
    EXPECT_TRUE(theirs[i] == expected) << json::diff(expected, theirs[i]).dump();
  }
}

constexpr std::size_t scans = 25;

TEST_F(Interoperability, CycloneReadsEveryFieldOfEveryMessageOfTheChain) {
  // Lossless, so that both readers get all on a busy machine, too.
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 50, scans: 25, dropout: 0.02}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
  - {name: columns, kind: circle_fitting, input: walls}
)",
                                  "qos: lossless\n");
  runtime::Participant participant(deployment.participant("test"));
  const std::vector<std::string> services{"columns", "corners", "wctls", "walls", "front"};
  std::vector<std::string> arguments{std::to_string(deployment.deployment().domain),
                                     std::to_string(scans)};
  for (const std::string& service : services) arguments.push_back(deployment.topic(service));
  Process cyclone("cyclone_reader", arguments, deployment.directory().path());
  // Each waits for the readers of this test and of the Cyclone program. Those of the test come when
  // the Cyclone program knows the writer, too: to it, what is written before is not for it.
  std::vector<Process> processes;
  for (const std::string& service : services) {
    processes.push_back(deployment.start(service, 2));
    const std::string known = deployment.topic(service) + ": 1 writers";
    ASSERT_TRUE(
        tests::eventually([&] { return cyclone.errors().find(known) != std::string::npos; }, 30s))
        << cyclone.errors();
  }
  Recorder<msg::Scan> our_scans(participant, deployment, "front");
  Recorder<msg::Segments> our_segments(participant, deployment, "walls");
  Recorder<msg::Lines> our_lines(participant, deployment, "wctls");
  Recorder<msg::Corners> our_corners(participant, deployment, "corners");
  Recorder<msg::Circles> our_circles(participant, deployment, "columns");

  EXPECT_TRUE(tests::eventually([&] {
    return std::min({our_scans.poll(), our_segments.poll(), our_lines.poll(), our_corners.poll(),
                     our_circles.poll()}) >= scans;
  }));
  EXPECT_EQ(cyclone.wait(20s), 0) << cyclone.errors();
  auto theirs = messages_of(cyclone);
  expect_same(theirs[deployment.topic("front")], our_scans.messages());
  expect_same(theirs[deployment.topic("walls")], our_segments.messages());
  expect_same(theirs[deployment.topic("wctls")], our_lines.messages());
  expect_same(theirs[deployment.topic("corners")], our_corners.messages());
  expect_same(theirs[deployment.topic("columns")], our_circles.messages());
  EXPECT_GE(our_corners.messages().back().corners().size(), 4U) << "a room has four corners";

  // Who comes late gets the latest heartbeat of every service that is alive; the source has ended.
  const std::string status = status_topic(deployment.deployment().name_space);
  const Process late("cyclone_reader", {arguments[0], "1000", status},
                     deployment.directory().path());
  std::map<std::string, json> latest;
  const auto all_done = [&] {
    const auto heard = messages_of(late);
    if (heard.empty()) return false;
    for (const json& message : heard.at(status)) latest[message.at("service")] = message;
    return std::all_of(services.begin(), services.end() - 1, [&](const std::string& service) {
      return latest.count(service) == 1 && latest[service].at("published") == scans;
    });
  };
  EXPECT_TRUE(tests::eventually(all_done)) << late.output() << late.errors();
  EXPECT_EQ(latest["wctls"]["kind"], "line_fitting");
  EXPECT_EQ(latest["wctls"]["received"], scans);
  EXPECT_EQ(latest["wctls"]["lost"], 0);
}

TEST_F(Interoperability, AScanOfCycloneBecomesCorners) {
  // The source is in the file, so that the others know its topic, but its process is not started.
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)");
  runtime::Participant participant(deployment.participant("test"));
  Recorder<msg::Scan> our_scans(participant, deployment, "front");
  tests::CornerRecorder corners(participant, deployment, "corners");
  const Process last = deployment.start("corners", 1);
  const Process middle = deployment.start("wctls");
  const Process first = deployment.start("walls");
  // It waits for the readers of "walls" and of this test.
  Process cyclone("cyclone_source",
                  {std::to_string(deployment.deployment().domain),
                   deployment.deployment().name_space, "front", std::to_string(scans), "2"},
                  deployment.directory().path());
  ASSERT_TRUE(tests::eventually([&] {
    our_scans.poll();
    return corners.poll() >= scans;
  })) << cyclone.errors();
  EXPECT_EQ(cyclone.wait(20s), 0) << cyclone.errors();

  ASSERT_EQ(our_scans.messages().size(), scans);
  const msg::Scan& scan = our_scans.messages().back();
  EXPECT_EQ(topics::source(scan.header()), "front");
  EXPECT_EQ(topics::sequence_number(scan.header()), scans - 1);
  EXPECT_EQ(scan.header().frame(), "laser");
  EXPECT_EQ(scan.sensor_model().range_stddev(), 0.010);
  EXPECT_EQ(scan.range_max(), 40.0F);
  EXPECT_TRUE(scan.qualities().empty());
  ASSERT_EQ(scan.bearings().size(), 720U);
  ASSERT_EQ(scan.ranges().size(), 720U);
  EXPECT_EQ(scan.ranges()[10], INFINITY);
  EXPECT_EQ(scan.ranges()[11], -INFINITY);
  EXPECT_TRUE(std::isnan(scan.ranges()[12]));
  EXPECT_FLOAT_EQ(scan.ranges()[360], 2.5F / std::cos(scan.bearings()[360])) << "the wall in front";

  EXPECT_EQ(corners.messages().size(), scans);
  EXPECT_THAT(corners.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_EQ(corners.accounting().duplicates(), 0U);
  EXPECT_EQ(corners.accounting().first_sequence(), 0U);
  const auto at = [](double x, double y) {
    return testing::AllOf(testing::Property("x", &msg::Corner::x, testing::DoubleNear(x, 1e-4)),
                          testing::Property("y", &msg::Corner::y, testing::DoubleNear(y, 1e-4)));
  };
  for (const msg::Corners& message : corners.messages()) {
    EXPECT_THAT(message.corners(), testing::UnorderedElementsAre(at(2.5, 1.25), at(-1.5, 1.25),
                                                                 at(-1.5, -1.75), at(2.5, -1.75)));
    ASSERT_EQ(message.header().trace().size(), 4U);
    EXPECT_EQ(message.header().trace()[0].service(), "front");
    EXPECT_EQ(message.header().trace()[0].index(), topics::sequence_number(message.header()));
  }
}

TEST(Bags, OfRos1OwnLibraryAreReadWithTheirOdometry) {
  const std::filesystem::path python = "/usr/bin/python3";  // Debian's, which has the library
  const std::filesystem::path script = QUOIN_INTEROPERABILITY_DIR "/ros1_bag.py";
  const tests::TemporaryFolder folder;
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    const auto file = folder.path() / (compression + ".bag");
    Process writer(python.string(), {script.string(), file.string(), compression}, folder.path());
    const auto code = writer.wait(60s);
    if (code != 0 && writer.errors().find("ModuleNotFoundError") != std::string::npos) {
      GTEST_SKIP() << "no python3-rosbag; tests/packages.txt names its packages";
    }
    ASSERT_EQ(code, 0) << writer.errors();
    sensor_bridge::ReplayParameters parameters;
    parameters.odometry = true;
    sensor_bridge::ScanFiles files(file, parameters);
    sensor_bridge::RecordedScan scan;
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(files.next(scan)) << compression;
      EXPECT_EQ(scan.epoch_stamp, 1'600'000'000'250'000'000 + i * std::int64_t{1'000'000'000});
      EXPECT_THAT(scan.ranges, testing::ElementsAre(1.0F + static_cast<float>(i), 2.0F, 3.0F,
                                                    INFINITY, 3.0F, 2.0F, 1.0F));
      EXPECT_FLOAT_EQ(scan.bearings.back(), 1.5F);
      EXPECT_EQ(scan.qualities.size(), 7U);
      ASSERT_EQ(scan.odometry.size(), 1U);
      EXPECT_EQ(scan.odometry[0].pose.x, 0.5 * i);
      EXPECT_EQ(scan.odometry[0].covariance(0, 0), 0.01);
      EXPECT_EQ(scan.odometry[0].child_frame, "base_footprint");
    }
    EXPECT_FALSE(files.next(scan));
  }
}

}  // namespace
}  // namespace quoin
