// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/recorder/recorder.hpp"

#include <array>
#include <cstdio>
#include <cstring>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Status.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/message_files/mcap_reader.hpp"
#include "services/topics/header.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

constexpr std::int64_t second = 1'000'000'000;

struct Sent {
  topics::RawMessage raw;
  msg::Header header;
};

template <class T>
Sent sent(std::uint64_t number) {
  T message;
  msg::Header& header = message.header();
  header.frame("laser");
  header.stamp(static_cast<std::int64_t>(number + 1) * second);
  topics::set_origin(header, "front", 1, number);
  header.trace().resize(1);
  header.trace()[0].service("front");
  header.trace()[0].index(number);
  Sent result;
  encode(message, result.raw);
  result.raw.published = result.raw.received = header.stamp();
  result.header = header;
  return result;
}

const RecordedTopic scans{"t/front/scan", "front", topics::find_topic_type("scan"), "sensor"};
const RecordedTopic lines{"t/map/lines", "map", topics::find_topic_type("lines"), "state"};

class RecorderTest : public ::testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  RecorderParameters parameters_ = [] {
    RecorderParameters parameters;
    parameters.keep_free = 0.0;
    return parameters;
  }();

  /// Messages of each topic of a file, which must be whole.
  static std::map<std::string, int> counts(const std::filesystem::path& file) {
    sensor_bridge::mcap::Reader reader(file);
    sensor_bridge::mcap::RecordedMessage message;
    std::map<std::string, int> result;
    while (reader.next(message)) ++result[message.channel->topic];
    EXPECT_TRUE(reader.complete());
    return result;
  }
};

TEST_F(RecorderTest, RecordsEachMessageForReplayAndForViewers) {
  Recorder recorder(folder_.path() / "a.mcap", parameters_, {scans}, {});
  for (std::uint64_t i = 0; i < 3; ++i) {
    const Sent message = sent<msg::Scan>(i);
    recorder.record(0, message.raw, message.header);
  }
  recorder.finish();
  EXPECT_EQ(recorder.figures().recorded, 3U);
  EXPECT_THAT(
      counts(folder_.path() / "a.mcap"),
      UnorderedElementsAre(std::pair("t/front/scan", 3), std::pair("t/front/scan/protobuf", 3),
                           std::pair("t/front/scan/points", 3), std::pair("tf", 1)));
}

TEST_F(RecorderTest, KeepsTheBytesAndTimes) {
  parameters_.content = RecordedContent::cdr;
  const Sent message = sent<msg::Scan>(7);
  {
    Recorder recorder(folder_.path() / "a.mcap", parameters_, {scans}, {});
    recorder.record(0, message.raw, message.header);
  }
  sensor_bridge::mcap::Reader reader(folder_.path() / "a.mcap");
  sensor_bridge::mcap::RecordedMessage recorded;
  ASSERT_TRUE(reader.next(recorded));
  ASSERT_EQ(recorded.data.size(), message.raw.cdr.size());
  EXPECT_EQ(std::memcmp(recorded.data.data(), message.raw.cdr.data(), recorded.data.size()), 0);
  EXPECT_EQ(recorded.sequence, 7U);
  EXPECT_EQ(recorded.log_time, static_cast<std::uint64_t>(8 * second));
  EXPECT_EQ(recorded.channel->message_encoding, "cdr");
  EXPECT_EQ(recorded.schema->name, "quoin::msg::Scan");
  EXPECT_EQ(recorded.schema->data, topics::idl_text("Scan.idl"));
  EXPECT_FALSE(reader.next(recorded));
}

TEST_F(RecorderTest, KeepsHeartbeatsAndTheLastOfEachServiceInEveryFile) {
  parameters_.split = "0.001MB";  // nearly each message begins a file
  Recorder recorder(folder_.path() / "a.mcap", parameters_, {scans}, {}, "t/status");
  msg::ServiceStatus status;
  status.state(msg::ServiceState::STATE_ACTIVE);
  for (const char* service : {"front", "walls"}) {
    status.service(service);
    recorder.record_heartbeat(status);
  }
  status.detail("no input");
  recorder.record_heartbeat(status);
  const Sent message = sent<msg::Scan>(0);
  recorder.record(0, message.raw, message.header);
  recorder.finish();
  EXPECT_EQ(recorder.figures().recorded, 4U);
  const auto files = recorder.files();
  ASSERT_GE(files.size(), 2U);
  EXPECT_EQ(counts(files.front())["t/status"], 1);
  auto last = counts(files.back());
  EXPECT_EQ(last["t/front/scan"], 1);
  EXPECT_EQ(last["t/status"], 2) << "of front and walls";
  EXPECT_EQ(last["t/status/log"], 1) << "of the one that says something";
}

TEST_F(RecorderTest, CountsWhatNeverCame) {
  Recorder recorder(folder_.path() / "a.mcap", parameters_, {scans}, {});
  for (const std::uint64_t i : {0U, 1U, 4U, 4U}) {
    const Sent message = sent<msg::Scan>(i);
    recorder.record(0, message.raw, message.header);
  }
  recorder.finish();
  EXPECT_EQ(recorder.figures().missed, 2U);
  EXPECT_EQ(recorder.figures().recorded, 3U);  // the repetition is not
}

TEST_F(RecorderTest, EachFileBeginsWithTheNewestStates) {
  parameters_.content = RecordedContent::cdr;
  parameters_.split = "10s";
  Recorder recorder(folder_.path() / "a.mcap", parameters_, {scans, lines}, {});
  const Sent map = sent<msg::Lines>(0);
  recorder.record(1, map.raw, map.header);
  for (std::uint64_t i = 0; i < 25; ++i) {
    const Sent message = sent<msg::Scan>(i);
    recorder.record(0, message.raw, message.header);
  }
  recorder.finish();
  ASSERT_EQ(recorder.files().size(), 3U);
  EXPECT_EQ(recorder.files()[1].filename(), "a_2.mcap");
  int all = 0;
  for (const auto& file : recorder.files()) {
    const auto found = counts(file);
    EXPECT_EQ(found.at("t/map/lines"), 1) << file;
    all += found.at("t/front/scan");
  }
  EXPECT_EQ(all, 25);
}

TEST_F(RecorderTest, TakesTheNextNameRatherThanAFileThatIsThere) {
  folder_.write("a.mcap", "of somebody");
  folder_.write("a_2.mcap.part", "of a recording that was killed");
  Recorder recorder(folder_.path() / "a.mcap", parameters_, {scans}, {});
  recorder.finish();
  EXPECT_THAT(recorder.files(), ElementsAre(folder_.path() / "a_3.mcap"));
}

TEST_F(RecorderTest, StopsInTimeBeforeTheDiskIsFull) {
  Recorder recorder(folder_.path() / "a.mcap", parameters_, {scans}, {});
  recorder.finish();
  parameters_.keep_free = 1e9;
  EXPECT_THROW(Recorder(folder_.path() / "b.mcap", parameters_, {scans}, {}),
               sensor_bridge::mcap::WriteError);
}

/// Exit code of `node PROGRAM ARGUMENT`, whose output is taken; nothing where node or the programs
/// of others are not there (npm install in tests/npm).
std::optional<int> node(const std::string& program, const std::string& argument,
                        std::string& output) {
  const std::filesystem::path clients = QUOIN_CLIENTS_DIR;
  if (!std::filesystem::exists(clients / "node_modules/@mcap/core")) return std::nullopt;
  const std::string line = "node '" + (clients / program).string() + "' '" + argument + "' 2>&1";
  FILE* pipe = ::popen(line.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::array<char, 4096> piece{};
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), pipe)) {
    output.append(piece.data(), count);
  }
  return ::pclose(pipe);
}

TEST_F(RecorderTest, OthersReadWhatItWrites) {
  for (const auto compression : {sensor_bridge::Compression::none, sensor_bridge::Compression::zstd,
                                 sensor_bridge::Compression::lz4}) {
    parameters_.compression = compression;
    const std::filesystem::path file =
        folder_.path() / (std::string(enum_name(compression)) + ".mcap");
    RunFacts facts;
    facts.metadata["quoin.host"] = {{"name", "robot"}};
    facts.deployment_name = "robot.yaml";
    facts.deployment_text = "version: 1";
    Recorder recorder(file, parameters_, {scans, lines}, facts);
    for (std::uint64_t i = 0; i < 30; ++i) {
      const Sent scan = sent<msg::Scan>(i);
      recorder.record(0, scan.raw, scan.header);
      const Sent line = sent<msg::Lines>(i);
      recorder.record(1, line.raw, line.header);
    }
    recorder.finish();
    std::string output;
    const auto code = node("mcap.mjs", file.string(), output);
    if (!code) GTEST_SKIP() << "node or @mcap/core are not there: npm install in tests/npm";
    EXPECT_EQ(*code, 0) << output;
    // Both as sent, as Protobuf, and for viewers; the frame.
    EXPECT_THAT(output, ::testing::HasSubstr("\"messages\": 181"));
  }
}

TEST(FoxgloveSchemas, HaveThePublishedNumbers) {
  std::string output;
  const auto code = node("foxglove_schemas.mjs", QUOIN_IDL_DIR, output);
  if (!code) GTEST_SKIP() << "node or the schemas are not there: npm install in tests/npm";
  EXPECT_EQ(*code, 0) << output;
}

TEST(ParseSplit, TakesTimesAndSizes) {
  EXPECT_EQ(parse_split("10min").seconds, 600.0);
  EXPECT_EQ(parse_split("1.5 h").seconds, 5400.0);
  EXPECT_EQ(parse_split("1GB").bytes, 1'000'000'000U);
  EXPECT_EQ(parse_split("").seconds, 0.0);
  for (const char* text : {"10", "GB", "-1s", "10 parsecs", "1e300h"}) {
    EXPECT_THROW((void)parse_split(text), ParameterError) << text;
  }
}

}  // namespace
}  // namespace quoin
