// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/message_files/mcap_codec.hpp"
#include "sensor_bridge/message_files/mcap_reader.hpp"
#include "sensor_bridge/message_files/mcap_writer.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge::mcap {
namespace {

using ::testing::HasSubstr;

std::string text_of(int number) { return "message " + std::to_string(number); }

std::string read_all(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A file of `count` messages on two topics, a chunk every ten.
std::filesystem::path written(const tests::TemporaryFolder& folder, const char* name,
                              Compression compression, int count) {
  const std::filesystem::path path = folder.path() / name;
  Writer writer(path, {.compression = compression});
  const std::uint16_t schema = writer.add_schema("t::Text", "omgidl", "struct Text {};");
  const std::uint16_t first = writer.add_channel(schema, "a", "cdr", {{"qos", "sensor"}});
  const std::uint16_t second = writer.add_channel(0, "b", "json");
  writer.add_metadata("host", {{"name", "robot"}});
  writer.add_attachment("robot.yaml", "text/yaml", "version: 1", 5);
  for (int i = 0; i < count; ++i) {
    const std::string text = text_of(i);
    const auto time = static_cast<std::uint64_t>(1000 + i);
    writer.write(
        {i % 2 == 0 ? first : second, static_cast<std::uint32_t>(i), time, time - 1, {text}});
    if (i % 10 == 9) writer.flush();
  }
  writer.finish();
  return path;
}

/// The messages up to the end or the first damage, whose text is returned.
std::string read_until_error(Reader& reader, std::vector<std::string>& messages) {
  RecordedMessage message;
  try {
    while (reader.next(message)) messages.emplace_back(message.data);
  } catch (const ScanFileError& error) {
    return error.what();
  }
  return "";
}

class Mcap : public ::testing::TestWithParam<Compression> {
 protected:
  tests::TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Compressions, Mcap,
                         ::testing::Values(Compression::none, Compression::zstd, Compression::lz4),
                         [](const auto& of) { return std::string(enum_name(of.param)); });

TEST_P(Mcap, GivesBackWhatWasWritten) {
  Reader reader(written(folder_, "a.mcap", GetParam(), 25));
  RecordedMessage message;
  for (int i = 0; i < 25; ++i) {
    ASSERT_TRUE(reader.next(message));
    EXPECT_EQ(message.data, text_of(i));
    EXPECT_EQ(message.sequence, static_cast<std::uint32_t>(i));
    EXPECT_EQ(message.log_time, static_cast<std::uint64_t>(1000 + i));
    EXPECT_EQ(message.publish_time, static_cast<std::uint64_t>(999 + i));
    EXPECT_EQ(message.channel->topic, i % 2 == 0 ? "a" : "b");
    ASSERT_EQ(message.schema != nullptr, i % 2 == 0);
  }
  EXPECT_FALSE(reader.next(message));
  EXPECT_TRUE(reader.complete());
  ASSERT_EQ(reader.metadata().size(), 1U);
  EXPECT_EQ(reader.metadata()[0].entries.at("name"), "robot");
}

TEST_P(Mcap, SummarizesWhatWasWritten) {
  const Reader reader(written(folder_, "a.mcap", GetParam(), 25));
  const auto summary = reader.summary();
  ASSERT_TRUE(summary);
  ASSERT_TRUE(summary->statistics);
  EXPECT_EQ(summary->statistics->messages, 25U);
  EXPECT_EQ(summary->statistics->channel_messages.at(1), 13U);
  EXPECT_EQ(summary->statistics->start, 1000U);
  EXPECT_EQ(summary->statistics->end, 1024U);
  EXPECT_EQ(summary->chunks.size(), 3U);
  EXPECT_EQ(summary->channels.at(1).metadata.at("qos"), "sensor");
  ASSERT_EQ(summary->attachments.size(), 1U);
  EXPECT_EQ(reader.attachment_at(summary->attachments[0]), "version: 1");
  ASSERT_EQ(summary->metadata.size(), 1U);
  EXPECT_EQ(reader.metadata_at(summary->metadata[0]).name, "host");
}

TEST_P(Mcap, PassesOverChunksBeforeATime) {
  Reader reader(written(folder_, "a.mcap", GetParam(), 25));
  reader.skip_until(1010);
  std::vector<std::string> messages;
  EXPECT_EQ(read_until_error(reader, messages), "");
  ASSERT_EQ(messages.size(), 15U);
  EXPECT_EQ(messages.front(), text_of(10));
}

TEST_P(Mcap, ACutIsNoticedAndWhatIsBeforeItIsGiven) {
  const std::string whole = read_all(written(folder_, "a.mcap", GetParam(), 20));
  std::size_t best = 0;
  for (std::size_t size = 0; size + 1 < whole.size(); size += 31) {
    const std::filesystem::path cut = folder_.write("cut.mcap", whole.substr(0, size));
    std::vector<std::string> messages;
    try {
      Reader reader(cut);
      const std::string error = read_until_error(reader, messages);
      if (!reader.complete()) {
        EXPECT_THAT(error, HasSubstr("cut.mcap: byte ")) << size;
      }
    } catch (const ScanFileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cut.mcap: byte ")) << size;
    }
    EXPECT_EQ(messages.size() % 10, 0U) << size;
    best = std::max(best, messages.size());
  }
  EXPECT_EQ(best, 20U);
}

TEST_P(Mcap, AChangedByteOfTheDataIsNoticed) {
  const std::string whole = read_all(written(folder_, "a.mcap", GetParam(), 20));
  Reader original(folder_.path() / "a.mcap");
  std::vector<std::string> all;
  ASSERT_EQ(read_until_error(original, all), "");
  const std::size_t end_of_data = original.offset();
  for (std::size_t at = magic.size(); at < end_of_data; at += 17) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    const std::filesystem::path file = folder_.write("b.mcap", damaged);
    try {
      Reader reader(file);
      std::vector<std::string> messages;
      EXPECT_NE(read_until_error(reader, messages), "") << at;
    } catch (const ScanFileError&) {
    }
  }
}

TEST_P(Mcap, GoesOnBehindADamagedChunk) {
  const std::filesystem::path path = written(folder_, "a.mcap", GetParam(), 30);
  const auto summary = Reader(path).summary();
  std::string bytes = read_all(path);
  const ChunkIndex& second = summary->chunks[1];
  bytes[second.chunk_offset + second.chunk_length - 3] ^= 0x55;
  Reader reader(folder_.write("b.mcap", bytes));
  std::vector<std::string> messages;
  EXPECT_THAT(read_until_error(reader, messages),
              HasSubstr("byte " + std::to_string(second.chunk_offset)));
  EXPECT_EQ(messages.size(), 10U);
  while (reader.resume()) (void)read_until_error(reader, messages);
  ASSERT_EQ(messages.size(), 20U);
  EXPECT_EQ(messages.back(), text_of(29));
}

class McapFile : public ::testing::Test {
 protected:
  tests::TemporaryFolder folder_;

  /// What is wrong with a file of these records behind a header.
  std::string error_of(const std::string& records) {
    std::string bytes(magic);
    append_record(Header{"", "test"}, bytes);
    Reader reader(folder_.write("made.mcap", bytes + records));
    std::vector<std::string> messages;
    return read_until_error(reader, messages);
  }
};

TEST_F(McapFile, IsNotReplaced) {
  const std::filesystem::path path = written(folder_, "a.mcap", Compression::zstd, 5);
  EXPECT_THROW(Writer(path, {}), WriteError);
  folder_.write("b.mcap.part", "of somebody");
  EXPECT_THROW(Writer(folder_.path() / "b.mcap", {}), WriteError);
  EXPECT_EQ(read_all(folder_.path() / "b.mcap.part"), "of somebody");
}

TEST_F(McapFile, IsReadableWhileItIsWritten) {
  Writer writer(folder_.path() / "a.mcap", {});
  const std::uint16_t channel = writer.add_channel(0, "a", "json");
  writer.write({channel, 0, 1, 1, {"first"}});
  writer.flush();
  writer.write({channel, 1, 2, 2, {"second"}});  // still in memory
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a.mcap"));
  Reader reader(folder_.path() / "a.mcap.part");
  std::vector<std::string> messages;
  EXPECT_THAT(read_until_error(reader, messages), HasSubstr("still being written"));
  EXPECT_EQ(messages, std::vector<std::string>{"first"});
}

TEST_F(McapFile, IsWholeWhenTheDiskIsFull) {
  // Stands for a full disk: the same way through the code, for any user.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto ignore = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{200'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);

  Writer writer(folder_.path() / "a.mcap", {.compression = Compression::none, .chunk_size = 9000});
  const std::uint16_t channel = writer.add_channel(0, "a", "json");
  const std::string text(1000, 'x');
  std::uint64_t sent = 0;
  EXPECT_THROW(
      {
        while (true) writer.write({channel, 0, ++sent, sent, {text}});
      },
      WriteError);
  writer.finish();

  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignore);
  Reader reader(folder_.path() / "a.mcap");
  std::vector<std::string> messages;
  EXPECT_EQ(read_until_error(reader, messages), "");
  EXPECT_GT(messages.size(), 150U);
  EXPECT_EQ(messages.size(), writer.messages());
  EXPECT_EQ(messages.size() + writer.dropped(), sent);
  EXPECT_EQ(reader.summary()->statistics->messages, messages.size());
}

TEST_F(McapFile, OfAnotherKindIsToldSo) {
  const std::filesystem::path file = folder_.write("a.mcap", "#ROSBAG V2.0\n");
  EXPECT_THROW(Reader{file}, ScanFileError);
}

TEST_F(McapFile, RefusesLengthsThatCannotBe) {
  // A record of nearly 2^64 bytes.
  EXPECT_THAT(error_of(std::string("\x05\xff\xff\xff\xff\xff\xff\xff\xff", 9)),
              HasSubstr("beyond the end"));
  // A chunk that promises 2^40 bytes.
  std::string chunk;
  append_record(Chunk{0, 1, std::uint64_t{1} << 40U, 0, "zstd", {"abc"}}, chunk);
  EXPECT_THAT(error_of(chunk), HasSubstr("more than the"));
}

TEST_F(McapFile, RefusesAChunkThatHoldsMoreThanItPromises) {
  // A bomb: a few hundred bytes that become a hundred million.
  std::string bomb;
  compress(Compression::zstd, std::string(100'000'000, '\0'), bomb);
  std::string chunk;
  append_record(Chunk{0, 1, 1000, 0, "zstd", {bomb}}, chunk);
  EXPECT_THAT(error_of(chunk), HasSubstr("more than the 1000 bytes"));
}

TEST_F(McapFile, NamesWhatItDoesNotKnow) {
  std::string chunk;
  append_record(Chunk{0, 1, 3, 0, "brotli", {"abc"}}, chunk);
  EXPECT_THAT(error_of(chunk), HasSubstr("'brotli'"));
}

TEST_F(McapFile, RefusesTwoSchemasOfOneNumber) {
  std::string records;
  append_record(Schema{1, "t::A", "omgidl", "struct A {};"}, records);
  append_record(Schema{1, "t::A", "omgidl", "struct A { long x; };"}, records);
  EXPECT_THAT(error_of(records), HasSubstr("declared twice"));
}

TEST_F(McapFile, RefusesMessagesOfChannelsThatAreNotDeclared) {
  std::string records;
  append_record(Message{7, 0, 0, 0, {"x"}}, records);
  EXPECT_THAT(error_of(records), HasSubstr("channel 7"));
}

TEST_F(McapFile, PassesOverRecordsOfLaterVersions) {
  std::string records("\x90\x03\0\0\0\0\0\0\0abc", 12);
  append_record(DataEnd{0}, records);
  EXPECT_EQ(error_of(records), "");
}

}  // namespace
}  // namespace quoin::sensor_bridge::mcap
