// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/replay_source.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/message_files/mcap_writer.hpp"
#include "sensor_bridge/recordings/line_reader.hpp"
#include "services/topics/cdr_codec.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/sensor_bridge/recording_source.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::RecordingSource;
using quoin::tests::source_config;
using quoin::tests::TemporaryFolder;
using ::testing::ElementsAre;

std::string flaser(const std::string& ranges, const std::string& stamp) {
  return "FLASER 2 " + ranges + " 1 2 0.5 3 4 0.25 " + stamp + " host 13\n";
}

TEST(ReplaySource, PublishesEveryScanAndReturns) {
  const TemporaryFolder folder;
  folder.write("a.log", flaser("1 81.91", "7") + flaser("0.01 0", "7.5"));
  const auto body = open_replay(source_config({{"path", "a.log"},
                                               {"range_min", "0.05"},
                                               {"range_stddev", "0.02"},
                                               {"bearing_stddev", "0.003"},
                                               {"range_bias_stddev", "0.004"},
                                               {"range_stddev_per_metre", "1 %"},
                                               {"flatness_stddev", "2 mm"},
                                               {"noise", "estimated"},
                                               {"frame", "front_laser"}}),
                                folder.path());
  RecordingSource source;
  const auto before = std::chrono::system_clock::now();
  body(source);
  const auto after = std::chrono::system_clock::now();

  ASSERT_EQ(source.scans.size(), 2U);
  const msg::Scan& scan = source.scans[0];
  EXPECT_EQ(scan.header().frame(), "front_laser");
  EXPECT_GE(scan.header().stamp(), std::chrono::nanoseconds(before.time_since_epoch()).count());
  EXPECT_LE(scan.header().stamp(), std::chrono::nanoseconds(after.time_since_epoch()).count());
  EXPECT_EQ(scan.sensor_model().range_stddev(), 0.02);
  EXPECT_EQ(scan.sensor_model().bearing_stddev(), 0.003);
  EXPECT_EQ(scan.sensor_model().range_bias_stddev(), 0.004);
  EXPECT_EQ(scan.sensor_model().range_stddev_per_metre(), 0.01);
  EXPECT_EQ(scan.sensor_model().flatness_stddev(), 0.002);
  EXPECT_TRUE(scan.sensor_model().estimated());
  EXPECT_EQ(scan.range_min(), 0.05F);
  EXPECT_EQ(scan.range_max(), 80.0F);
  EXPECT_EQ(scan.duration(), 0.0F);
  EXPECT_THAT(scan.ranges(), ElementsAre(1.0F, INFINITY));
  EXPECT_EQ(scan.bearings().size(), 2U);
  EXPECT_TRUE(scan.time_offsets().empty() && scan.qualities().empty());
  EXPECT_EQ(source.scans[1].ranges()[0], -INFINITY);
  EXPECT_TRUE(std::isnan(source.scans[1].ranges()[1]));
  EXPECT_EQ(source.deadlines[2] - source.deadlines[1], std::chrono::milliseconds(500));
  EXPECT_EQ(source.memory[0], source.memory[1]);
  EXPECT_THAT(source.warnings, ElementsAre());
}

TEST(ReplaySource, AScanOfOursComesAsItWasRecorded) {
  const TemporaryFolder folder;
  msg::Scan original;
  original.header().frame("front_laser");
  original.header().stamp(1'700'000'000'123'456'789);
  original.header().origins().resize(1);
  original.header().trace().resize(2);
  original.sensor_model().range_stddev(0.0123);
  original.sensor_model().estimated(true);
  original.range_min(0.125F);
  original.range_max(100.0F);
  original.duration(0.09F);
  original.bearings({-0.3F, 0.1F, 0.7F, 0.9F});
  original.ranges({90.5F, INFINITY, -INFINITY, 0.05F});
  original.qualities({0.5F, 0.0F, 0.0F, 1.0F});
  original.time_offsets({0.0F, 0.03F, 0.06F, 0.09F});
  topics::RawMessage raw;
  topics::encode(original, raw);
  {
    mcap::Writer writer(folder.path() / "a.mcap", {});
    const std::uint16_t other = writer.add_channel(0, "t/map", "json");
    const std::uint16_t schema = writer.add_schema("quoin::msg::Scan", "omgidl", "...");
    const std::uint16_t channel = writer.add_channel(schema, "t/front/scan", "cdr");
    writer.write({other, 0, 1, 1, {"{}"}});
    writer.write(
        {channel, 0, 2, 2, {{reinterpret_cast<const char*>(raw.cdr.data()), raw.cdr.size()}}});
    writer.finish();
  }
  RecordingSource source;
  open_replay(source_config({{"path", "a.mcap"}, {"stamps", "recorded"}}), folder.path())(source);
  ASSERT_EQ(source.scans.size(), 1U);
  msg::Scan replayed = source.scans[0];
  EXPECT_EQ(replayed.header().stamp(), original.header().stamp());
  EXPECT_EQ(replayed.header().frame(), original.header().frame());
  replayed.header(original.header());  // numbered anew
  topics::RawMessage again;
  topics::encode(replayed, again);
  EXPECT_EQ(again.cdr, raw.cdr);
}

TEST(ReplaySource, AFileWithoutScansTellsItsTopics) {
  const TemporaryFolder folder;
  mcap::Writer writer(folder.path() / "a.mcap", {});
  const std::uint16_t schema = writer.add_schema("std_msgs/msg/String", "ros2msg", "string data");
  const std::uint16_t channel = writer.add_channel(schema, "/chatter", "cdr");
  writer.write({channel, 0, 1, 1, {"x"}});
  writer.finish();
  const std::string error = error_of<ScanFileError>([&] {
    (void)open_replay(source_config({{"path", "a.mcap"}}), folder.path());
  });
  EXPECT_THAT(error, ::testing::HasSubstr("/chatter (std_msgs/msg/String)"));
}

TEST(ReplaySource, PublishesOdometryWithTheStampsOfTheScans) {
  const TemporaryFolder folder;
  folder.write("a.log", flaser("1 1", "7") + flaser("1 1", "7.5") + flaser("1 1", "7.25"));
  const ParameterSettings settings{
      {"path", "a.log"}, {"stamps", "recorded"}, {"odometry", "true"}, {"speed", "0"}};
  RecordingSource source;
  open_replay(source_config(settings), folder.path())(source);
  ASSERT_EQ(source.odometry.size(), 3U);
  const std::int64_t expected[] = {7'000'000'000, 7'500'000'000, 8'000'000'000};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(source.scans[i].header().stamp(), expected[i]) << "the last good period goes on";
    EXPECT_EQ(source.odometry[i].header().stamp(), expected[i]);
  }
  EXPECT_EQ(source.odometry[0].header().frame(), "odom");
  EXPECT_EQ(source.odometry[0].child_frame(), "base_link");
  EXPECT_EQ(source.odometry[0].pose().y(), 4.0);
  EXPECT_EQ(source.odometry[0].pose().covariance_xx(), 0.0) << "not known";
  EXPECT_FALSE(source.odometry[0].velocity_known());
}

template <class T>
T message_at(std::int64_t stamp) {
  T message;
  message.header().frame("laser");
  message.header().stamp(stamp);
  message.header().origins().resize(1);
  message.header().origins()[0].parts(1);
  message.header().trace().resize(2);
  message.sensor_model().range_stddev(0.01);
  return message;
}

/// Segments and lines of three scans, 100 ms apart, lines 1 ms after their segments; two topics
/// have lines.
void record_stages(const std::filesystem::path& file) {
  mcap::Writer writer(file, {});
  const std::uint16_t lines = writer.add_schema("quoin::msg::Lines", "omgidl", "...");
  const std::uint16_t segments = writer.add_schema("quoin::msg::Segments", "omgidl", "...");
  const std::uint16_t walls = writer.add_channel(segments, "t/walls/segments", "cdr");
  const std::uint16_t wctls = writer.add_channel(lines, "t/wctls/lines", "cdr");
  const std::uint16_t utls = writer.add_channel(lines, "t/utls/lines", "cdr");
  const auto write = [&](std::uint16_t channel, const auto& message, std::int64_t time) {
    topics::RawMessage raw;
    topics::encode(message, raw);
    const auto at = static_cast<std::uint64_t>(time);
    writer.write(
        {channel, 0, at, at, {{reinterpret_cast<const char*>(raw.cdr.data()), raw.cdr.size()}}});
  };
  for (std::int64_t scan = 1; scan <= 3; ++scan) {
    const std::int64_t stamp = scan * 100'000'000;
    write(walls, message_at<msg::Segments>(stamp), stamp + 5'000'000);
    auto found = message_at<msg::Lines>(stamp);
    found.covariance_mode("propagated");
    write(wctls, found, stamp + 6'000'000);
    found.covariance_mode("as_published");
    write(utls, found, stamp + 6'000'000);
  }
  writer.finish();
}

TEST(ReplaySource, PublishesAnyStageInItsOrderAndPace) {
  const TemporaryFolder folder;
  record_stages(folder.path() / "a.mcap");
  RecordingSource source;
  open_replay(source_config({{"path", "a.mcap"},
                             {"messages", "segments, lines"},
                             {"topic", "t/walls/segments, t/utls/lines"},
                             {"stamps", "recorded"}}),
              folder.path())(source);
  ASSERT_EQ(source.segments.size(), 3U);
  ASSERT_EQ(source.lines.size(), 3U);
  EXPECT_TRUE(source.scans.empty());
  auto expected = message_at<msg::Lines>(300'000'000);
  expected.covariance_mode("as_published");
  EXPECT_EQ(source.lines[2], expected);
  ASSERT_EQ(source.deadlines.size(), 6U);
  EXPECT_EQ(source.deadlines[1] - source.deadlines[0], std::chrono::milliseconds(1));
  EXPECT_EQ(source.deadlines[4] - source.deadlines[0], std::chrono::milliseconds(200));
}

TEST(ReplaySource, StagesOfOneScanKeepOneStamp) {
  const TemporaryFolder folder;
  record_stages(folder.path() / "a.mcap");
  RecordingSource source;
  open_replay(source_config({{"path", "a.mcap"},
                             {"messages", "segments,lines"},
                             {"topic", "t/walls/segments,t/wctls/lines"}}),
              folder.path())(source);
  ASSERT_EQ(source.lines.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(source.lines[i].header().stamp(), 1'700'000'000'000'000'000) << "that of now";
    EXPECT_EQ(source.lines[i].header().stamp(), source.segments[i].header().stamp());
  }
  EXPECT_NE(source.lines[0].header().stamp(), source.lines[1].header().stamp());
}

TEST(ReplaySource, StagesThatAreNotThereAreNamed) {
  const TemporaryFolder folder;
  record_stages(folder.path() / "a.mcap");
  const auto error = [&](const ParameterSettings& settings) {
    ParameterSettings all{{"path", "a.mcap"}};
    all.insert(all.end(), settings.begin(), settings.end());
    try {
      (void)open_replay(source_config(all), folder.path());
      return std::string("no error");
    } catch (const std::exception& failure) {
      return std::string(failure.what());
    }
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error({{"messages", "lines"}}), HasSubstr("several topics hold messages 'lines'"));
  EXPECT_THAT(error({{"messages", "corners"}}), HasSubstr("no topic holds messages 'corners'"));
  EXPECT_THAT(error({{"messages", "lines"}, {"topic", "t/x/lines"}}),
              HasSubstr("there is no topic 't/x/lines'; its topics are t/utls/lines"));
  EXPECT_THAT(error({{"messages", "lins"}}), HasSubstr("did you mean 'lines'?"));
  EXPECT_THAT(error({{"messages", "odometry"}}), HasSubstr("odometry: true"));
  EXPECT_THAT(error({{"messages", " , "}}), HasSubstr("names no type"));
}

/// Somebody who asks while the replay runs: each request when so many messages were published.
class AskedSource final : public RecordingSource {
 public:
  using Request = std::pair<std::size_t, ParameterSettings>;
  explicit AskedSource(std::vector<Request> requests) : requests_(std::move(requests)) {}

  bool answer_settings(const Settings& settings) override {
    settings_ = settings;
    return true;
  }
  bool wait_until(std::chrono::steady_clock::time_point time) override {
    ++waits_;
    if (waits_ - at_last_ >= 5 && next_ < requests_.size() &&
        scans.size() == requests_[next_].first) {
      answers.push_back(settings_(requests_[next_++].second));
      at_last_ = waits_;
    }
    std::this_thread::sleep_until(
        std::min(time, std::chrono::steady_clock::now() + std::chrono::milliseconds(2)));
    return waits_ < 20000;
  }

  std::vector<ParameterSettings> answers;

 private:
  Settings settings_;
  std::vector<Request> requests_;
  std::size_t next_ = 0;
  int waits_ = 0;
  int at_last_ = 0;
};

TEST(ReplaySource, IsPausedSteppedAndSpedUpWhileItRuns) {
  const TemporaryFolder folder;
  std::string log;
  for (int i = 0; i < 8; ++i) log += flaser("1 1", std::to_string(7 + i));
  folder.write("a.log", log);
  AskedSource source({{0, {{"step", "2"}}},
                      {2, {{"step", "1"}}},
                      {3, {{"speed", "0"}}},
                      {3, {{"paused", "false"}}}});
  const auto body =
      open_replay(source_config({{"path", "a.log"}, {"paused", "true"}}), folder.path());
  body(source);
  EXPECT_EQ(source.scans.size(), 8U);
  ASSERT_EQ(source.answers.size(), 4U) << "each came while it waited for it";
  EXPECT_EQ(source.answers[0], (ParameterSettings{{"paused", "true"}, {"speed", "1"}}));
  EXPECT_EQ(source.answers[3], (ParameterSettings{{"paused", "false"}, {"speed", "0"}}));
  EXPECT_THAT(source.diagnostics["Progress"], ::testing::HasSubstr("%"));
}

TEST(ReplaySource, RefusesSettingsThatItDoesNotHave) {
  const TemporaryFolder folder;
  folder.write("a.log", flaser("1 1", "7"));
  AskedSource source({{0, {{"pace", "2"}}}});
  const auto body =
      open_replay(source_config({{"path", "a.log"}, {"paused", "true"}}), folder.path());
  EXPECT_THROW(body(source), ParameterError);
}

TEST(ReplaySource, WarnsWhereThereIsNoOdometry) {
  const TemporaryFolder folder;
  folder.write("a.csv", "0,1\n");
  RecordingSource source;
  open_replay(source_config({{"path", "a.csv"}, {"odometry", "true"}}), folder.path())(source);
  EXPECT_THAT(source.warnings, ElementsAre("the recording holds no odometry"));
  EXPECT_EQ(source.scans.size(), 1U);
}

TEST(ReplaySource, StopsAfterTheNumberOfScansAskedFor) {
  const TemporaryFolder folder;
  folder.write("a.csv", "0,1\n");
  RecordingSource once;
  open_replay(source_config({{"path", "a.csv"}, {"scans", "5"}}), folder.path())(once);
  EXPECT_EQ(once.scans.size(), 1U);
  RecordingSource looped;
  open_replay(source_config({{"path", "a.csv"}, {"scans", "5"}, {"loop", "true"}}),
              folder.path())(looped);
  EXPECT_EQ(looped.scans.size(), 5U);
  EXPECT_THAT(looped.warnings, ElementsAre());
}

TEST(ReplaySource, StopsWhenAsked) {
  const TemporaryFolder folder;
  folder.write("a.csv", "0,1\n");
  RecordingSource source;
  source.stop_after = 3;
  open_replay(source_config({{"path", "a.csv"}, {"loop", "true"}, {"speed", "0"}}),
              folder.path())(source);
  EXPECT_EQ(source.scans.size(), 3U);
}

TEST(ReplaySource, WarnsOfStampsThatCannotBeUsed) {
  const TemporaryFolder folder;
  folder.write("a.log",
               flaser("1 1", "7") + flaser("1 1", "6") + flaser("1 1", "6") + flaser("1 1", "6.5"));
  RecordingSource source;
  open_replay(source_config({{"path", "a.log"}}), folder.path())(source);
  EXPECT_EQ(source.scans.size(), 4U);
  EXPECT_THAT(source.warnings,
              ElementsAre("scan 1 has no usable time stamp; the last good period is kept",
                          "2 scans had no usable time stamp"));
}

TEST(ReplaySource, PublishesTheGoodScansBeforeItFails) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("a.log", flaser("1 1", "7") + flaser("1 1", "8") + "FLASER 2 1");
  const auto body = open_replay(source_config({{"path", "a.log"}}), folder.path());
  RecordingSource source;
  EXPECT_EQ(error_of<runtime::SourceError>([&] { body(source); }),
            file +
                ":3:11: FLASER announces 2 ranges, but the line ends early; the file is cut off or "
                "damaged here");
  EXPECT_EQ(source.scans.size(), 2U);
}

TEST(ReplaySource, RefusesWhatIsMissingWhenOpened) {
  EXPECT_EQ(error_of<ScanFileError>([] {
              (void)open_replay(source_config({{"path", "a.log"}}), "/nowhere");
            }),
            "cannot read scan file '/nowhere/a.log': No such file or directory");
  EXPECT_EQ(
      error_of<ParameterError>([] { (void)open_replay(source_config({}), "/nowhere"); }),
      "is missing: recording (CARMEN, CSV, JSON, .dat, MCAP, ROS 1 and ROS 2 bags), or folder "
      "whose scan files are read in the order of their names (relative to the deployment file)");
}

}  // namespace
}  // namespace quoin::sensor_bridge
