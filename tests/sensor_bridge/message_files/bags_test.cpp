// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <bzlib.h>
#include <memory>
#include <sqlite3.h>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensor_bridge/message_files/compression.hpp"
#include "sensor_bridge/message_files/message_file.hpp"
#include "tests/sensor_bridge/message_files/bag_bytes.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tests::bag;
using tests::bag_connection;
using tests::bag_message;

class Bags : public ::testing::Test {
 protected:
  tests::TemporaryFolder folder_;

  /// "topic data" of each message; the error, if there is one, comes last.
  std::vector<std::string> read(const std::filesystem::path& file) {
    std::vector<std::string> messages;
    try {
      const auto opened = open_message_file(file);
      FileMessage message;
      while (opened->next(message)) {
        messages.push_back(message.topic->name + " " + std::string(message.data));
      }
    } catch (const ScanFileError& error) {
      messages.emplace_back(error.what());
    }
    return messages;
  }

  const std::string records_ = bag_connection(0, "/a", "t/A") + bag_message(0, 1, "one") +
                               bag_connection(5, "/b", "t/B") + bag_message(5, 2, "two") +
                               bag_message(0, 3, "three");
};

TEST_F(Bags, ChunksThatAreNotCompressed) {
  EXPECT_THAT(read(folder_.write("a.bag", bag(records_, "none", records_))),
              ElementsAre("/a one", "/b two", "/a three"));
}

TEST_F(Bags, ChunksByBz2) {
  std::string compressed(records_.size() + 1000, '\0');
  auto size = static_cast<unsigned>(compressed.size());
  ASSERT_EQ(BZ2_bzBuffToBuffCompress(compressed.data(), &size, const_cast<char*>(records_.data()),
                                     static_cast<unsigned>(records_.size()), 9, 0, 0),
            BZ_OK);
  compressed.resize(size);
  EXPECT_THAT(read(folder_.write("a.bag", bag(records_, "bz2", compressed))),
              ElementsAre("/a one", "/b two", "/a three"));
}

TEST_F(Bags, ChunksByLz4) {
  std::string compressed;
  compress(Compression::lz4, records_, compressed);
  EXPECT_THAT(read(folder_.write("a.bag", bag(records_, "lz4", compressed))),
              ElementsAre("/a one", "/b two", "/a three"));
}

TEST_F(Bags, TellTheirTopics) {
  const auto opened = open_message_file(folder_.write("a.bag", bag(records_, "none", records_)));
  FileMessage message;
  while (opened->next(message)) {
  }
  const auto topics = opened->topics();
  EXPECT_EQ(topics.at("/a").type, "t/A");
  EXPECT_EQ(topics.at("/a").messages, 2U);
  EXPECT_EQ(topics.at("/b").messages, 1U);
}

TEST_F(Bags, ThatAreCutOffGiveWhatIsBefore) {
  const std::string whole =
      bag(records_, "none", records_) + bag_connection(9, "/c", "t/C") + bag_message(9, 4, "four");
  const auto messages = read(folder_.write("a.bag", whole.substr(0, whole.size() - 3)));
  ASSERT_EQ(messages.size(), 4U);
  EXPECT_THAT(messages[3], HasSubstr("cut off"));
}

TEST_F(Bags, ThatAreDamagedAreToldSo) {
  std::string promised = bag(records_, "bz2", "no bz2 data at all");
  EXPECT_THAT(read(folder_.write("a.bag", promised))[0], HasSubstr("cannot be decompressed"));
  EXPECT_THAT(read(folder_.write("b.bag", bag(records_, "aes", records_)))[0], HasSubstr("'aes'"));
  EXPECT_THAT(
      read(folder_.write("c.bag", bag(bag_message(3, 1, "x"), "none", bag_message(3, 1, "x"))))[0],
      HasSubstr("not described"));
  EXPECT_THAT(read(folder_.write("d.bag", std::string(rosbag_magic) + "\xff\xff\xff\xff"))[0],
              HasSubstr("no record begins here"));
}

/// A bag of ROS 2 by the given statements.
std::filesystem::path data_base(const std::filesystem::path& file, const char* statements) {
  sqlite3* base = nullptr;
  EXPECT_EQ(sqlite3_open(file.c_str(), &base), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(base, statements, nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(base);
  return file;
}

constexpr const char* tables =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT, "
    "offered_qos_profiles TEXT);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"
    "INSERT INTO topics VALUES(1, '/a', 't/msg/A', 'cdr', '');"
    "INSERT INTO messages VALUES(1, 1, 2000, 'second'), (2, 1, 1000, 'first');";

TEST_F(Bags, OfRos2ComeInTheOrderOfTime) {
  EXPECT_THAT(read(data_base(folder_.path() / "a.db3", tables)),
              ElementsAre("/a first", "/a second"));
}

TEST_F(Bags, OfRos2ThatAreNoneAreToldSo) {
  EXPECT_THAT(read(data_base(folder_.path() / "a.db3", "CREATE TABLE t(x);"))[0],
              HasSubstr("no bag of ROS 2"));
  const std::string stray =
      std::string(tables) + "INSERT INTO messages VALUES(3, 8, 3000, 'of nobody');";
  EXPECT_THAT(read(data_base(folder_.path() / "b.db3", stray.c_str())).back(), HasSubstr("row 3"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
