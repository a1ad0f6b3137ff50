// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <fstream>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <iterator>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/node/clock.hpp"
#include "services/topics/header.hpp"
#include "tests/benchmarks/process_usage.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using tests::CornerRecorder;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

const char* const chain = R"(
  - {name: front, kind: simulated}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)";

msg::Header header(std::uint64_t sequence_number) {
  msg::Header made;
  topics::set_origin(made, "front", 1, sequence_number);
  made.stamp(runtime::now_ns());
  made.trace().resize(1);
  made.trace()[0].service("front");
  made.trace()[0].incarnation(1);
  made.trace()[0].index(sequence_number);
  made.trace()[0].published(runtime::now_ns());
  return made;
}

/// Scans as no healthy sensor sends them, and yet scans.
std::vector<msg::Scan> strange_scans() {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<msg::Scan> scans(6);
  // 0: nothing at all
  scans[1].bearings({0.0F});
  scans[1].ranges({1.0F});
  scans[2].bearings({0.0F, 0.1F, 0.2F});
  scans[2].ranges({1e30F, 1.0F, 1e-30F});
  scans[3].bearings(std::vector<float>(100, 99.0F));
  scans[3].ranges(std::vector<float>(100, nan));
  scans[4].bearings(std::vector<float>(100, 0.5F));  // all points equal
  scans[4].ranges(std::vector<float>(100, 2.0F));
  scans[5].bearings(std::vector<float>(100, 0.0F));
  scans[5].ranges(std::vector<float>(100, -inf));
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].header(header(i));
    scans[i].range_max(inf);
    scans[i].sensor_model().range_stddev(0.01);
    scans[i].sensor_model().bearing_stddev(0.002);
  }
  return scans;
}

TEST(BadInput, StrangeScansGiveEmptyResultsThatAreCounted) {
  const TestDeployment deployment(chain);
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder recorder(participant, deployment, "corners");
  StatusRecorder status(participant, deployment);
  runtime::Writer<msg::Scan> writer(participant, deployment.topic("front"),
                                    runtime::QosPreset::sensor);
  const Process corners = deployment.start("corners", 1);
  const Process wctls = deployment.start("wctls");
  const Process walls = deployment.start("walls");
  ASSERT_TRUE(writer.wait_for_readers(1, 20s));
  const auto scans = strange_scans();
  for (std::size_t i = 0; i < scans.size(); ++i) {
    ASSERT_TRUE(writer.write(scans[i]));
    ASSERT_TRUE(recorder.wait_for(i + 1)) << "no result for scan " << i;
    EXPECT_TRUE(recorder.messages().back().corners().empty()) << i;
  }
  EXPECT_THAT(recorder.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_TRUE(
      status.wait_for("walls", [&](const auto& s) { return s.failures() == scans.size(); }));
  EXPECT_EQ(status.latest("walls").lost(), 0U);
}

TEST(BadInput, SegmentsOutsideTheirPointsAreRefusedByNameAndNothingElseIs) {
  const TestDeployment deployment(chain);
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder recorder(participant, deployment, "corners");
  StatusRecorder status(participant, deployment);
  runtime::Writer<msg::Segments> writer(participant, deployment.topic("walls"),
                                        runtime::QosPreset::feature);
  const Process corners = deployment.start("corners", 1);
  const Process wctls = deployment.start("wctls");
  ASSERT_TRUE(writer.wait_for_readers(1, 20s));
  for (std::uint64_t i = 0; i < 3; ++i) {
    msg::Segments segments;
    segments.header(header(i));
    segments.bearings().resize(10);
    segments.ranges().resize(10);
    segments.segments().resize(1);
    segments.segments()[0].end(i == 1 ? 4'000'000'000U : 10U);
    ASSERT_TRUE(writer.write(segments));
  }
  ASSERT_TRUE(recorder.wait_for(2));
  EXPECT_EQ(topics::sequence_number(recorder.messages()[1].header()), 2U);
  EXPECT_THAT(recorder.accounting().lost_by_site(),
              testing::ElementsAre(
                  testing::Pair(runtime::LossSite{runtime::LossPlace::service, "wctls"}, 1)));
  EXPECT_TRUE(status.wait_for("wctls", [](const auto& s) { return s.received() == 2; }));
  EXPECT_EQ(status.latest("wctls").published(), 2U);
  EXPECT_EQ(status.latest("wctls").lost(), 1U);
  ASSERT_EQ(status.latest("wctls").losses().size(), 1U);
  EXPECT_EQ(status.latest("wctls").losses()[0].cause(), "link");
  const msg::InputStatus& input = status.latest("wctls").inputs().at(0);
  ASSERT_EQ(input.refused().size(), 1U);
  EXPECT_EQ(input.refused()[0].cause(), "segments: out of range");
  EXPECT_EQ(input.refused()[0].count(), 1U);
}

std::string carmen_line(int points) {
  std::string line = "FLASER " + std::to_string(points);
  for (int i = 0; i < points; ++i) line += " 2.5";
  return line + " 0 0 0 0 0 0 1.0 host 1.0\n";
}

std::string replay_chain(const std::filesystem::path& file) {
  return "  - {name: front, kind: replay, parameters: {path: " + file.string() +
         ", speed: 0}}\n"
         "  - {name: walls, kind: segmentation, input: front}\n"
         "  - {name: wctls, kind: line_fitting, input: walls}\n"
         "  - {name: corners, kind: corner_estimation, input: wctls}\n";
}

TEST(BadInput, GoodScansBeforeAMalformedLineAreStillPublished) {
  const tests::TemporaryFolder folder;
  const auto log =
      folder.write("walls.log", carmen_line(180) + carmen_line(180) + "FLASER 180 1.0 2.0 oops\n");
  const TestDeployment deployment(replay_chain(log), "qos: lossless\n");
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder recorder(participant, deployment, "corners");
  const Process corners = deployment.start("corners", 1);
  const Process wctls = deployment.start("wctls");
  const Process walls = deployment.start("walls");
  Process front = deployment.start("front");
  EXPECT_TRUE(recorder.wait_for(2));
  EXPECT_EQ(front.wait(20s), 3);
  EXPECT_THAT(front.errors(), HasSubstr(log.string() + ":3:"));
  EXPECT_EQ(recorder.poll(), 2U);
}

// Gigabytes of empty lines in a few megabytes.
TEST(BadInput, ASourceThatFindsNoScanForEverEndsAtASignal) {
  const tests::TemporaryFolder folder;
  const auto log = folder.write("empty.log.gz", "");
  const std::string lines(1U << 20U, '\n');
  gzFile part = ::gzopen(log.c_str(), "wb1");
  for (int i = 0; i < 64; ++i) ::gzwrite(part, lines.data(), static_cast<unsigned>(lines.size()));
  ::gzclose(part);
  std::ifstream stream(log, std::ios::binary);
  const std::string member((std::istreambuf_iterator<char>(stream)), {});
  std::ofstream whole(log, std::ios::binary | std::ios::app);
  for (int i = 0; i < 300; ++i) whole << member;
  whole.close();
  const TestDeployment deployment(
      "\n  - {name: front, kind: replay, parameters: {path: " + log.string() + "}}\n");
  runtime::Participant participant(deployment.participant("test"));
  StatusRecorder status(participant, deployment);
  Process front = deployment.start("front");
  ASSERT_TRUE(status.wait_for(
      "front", [](const auto& heartbeat) { return heartbeat.state() == msg::STATE_ACTIVE; }));
  // In the middle of it, and not before it has begun.
  ASSERT_TRUE(tests::eventually([&] { return benchmarks::processor_time(front.pid()) > 300ms; }));
  front.signal(SIGTERM);
  EXPECT_EQ(front.wait(10s), 1);
  EXPECT_THAT(front.errors(), HasSubstr("service 'front' does not end"));
}

TEST(BadInput, AMissingScanFileStopsTheStart) {
  const TestDeployment deployment(replay_chain("/nonexistent/scans.log"));
  Process front = deployment.start("front");
  EXPECT_EQ(front.wait(20s), 2);
  EXPECT_THAT(front.errors(), HasSubstr("/nonexistent/scans.log"));
}

TEST(BadInput, AMalformedDeploymentStartsNothing) {
  const tests::TemporaryFolder folder;
  const auto file =
      folder.write("broken.yaml", "version: 1\nservices:\n  - {name: front, kind: lidar}\n");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"check", file.string()},
        {"up", file.string(), "--duration", "1"}}) {
    Process quoin("quoin", arguments, folder.path());
    EXPECT_EQ(quoin.wait(20s), 2) << arguments[0];
    EXPECT_THAT(quoin.errors(), HasSubstr(file.string() + ":3:25: unknown kind 'lidar'"))
        << arguments[0];
  }
}

TEST(BadInput, OutOfMemoryEndsWithAMessage) {
  const TestDeployment deployment(chain);
  const std::string program = std::filesystem::path(QUOIN_BIN_DIR) / "quoin-segmentation";
  std::size_t ended = 0;
  for (const char* limit : {"60000", "70000", "80000", "90000", "100000"}) {  // [KiB]
    const std::string command = std::string("ulimit -v ") + limit + "; exec " + program +
                                " --service walls --deployment " + deployment.file().string();
    Process service("/bin/sh", {"-c", command}, deployment.directory().path());
    const auto code = service.wait(2s);
    if (!code) continue;         // enough of it
    if (*code == 127) continue;  // too little to load it
    ++ended;
    EXPECT_EQ(*code, 1) << limit;
    EXPECT_THAT(service.errors(), Not(IsEmpty())) << limit;
    EXPECT_THAT(service.errors(), Not(HasSubstr("terminate called"))) << limit;
  }
  EXPECT_GT(ended, 0U);
}

TEST(BadInput, AServiceRefusesAWrongCommandLine) {
  const TestDeployment deployment(chain);
  Process unknown("quoin-line-fitting",
                  {"--deployment", deployment.file().string(), "--service", "wclts"},
                  deployment.directory().path());
  EXPECT_EQ(unknown.wait(20s), 2);
  EXPECT_THAT(unknown.errors(), HasSubstr("did you mean 'wctls'?"));
  Process none("quoin-line-fitting", {}, deployment.directory().path());
  EXPECT_EQ(none.wait(20s), 2);
}

}  // namespace
}  // namespace quoin
