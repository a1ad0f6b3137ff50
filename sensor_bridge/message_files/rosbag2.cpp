// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/rosbag2.hpp"

#include <sqlite3.h>

#include "sensor_bridge/message_files/compression.hpp"

namespace quoin::sensor_bridge {

namespace {

std::string text_column(sqlite3_stmt& statement, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(&statement, column));
  return text == nullptr ? "" : text;
}

}  // namespace

void Rosbag2::Close::operator()(sqlite3* base) const { sqlite3_close_v2(base); }
void Rosbag2::Close::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Rosbag2::Rosbag2(const std::filesystem::path& file) : MessageFile(file, "row") {
  sqlite3* opened = nullptr;
  const int result =
      sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, nullptr);
  base_.reset(opened);
  if (result != SQLITE_OK) {
    throw ScanFileError("cannot read scan file '" + name() + "': " + sqlite3_errstr(result));
  }
  // The file may be of anybody.
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(largest_chunk));
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  const Statement topics = prepare("SELECT id, name, type, serialization_format FROM topics");
  while (step(*topics)) {
    topics_[sqlite3_column_int64(topics.get(), 0)] = {
        text_column(*topics, 1), text_column(*topics, 2), text_column(*topics, 3), 0};
  }
  messages_ = prepare("SELECT id, topic_id, timestamp, data FROM messages ORDER BY timestamp, id");
}

Rosbag2::~Rosbag2() = default;

Rosbag2::Statement Rosbag2::prepare(const char* text) const {
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(base_.get(), text, -1, &prepared, nullptr) != SQLITE_OK) {
    throw ScanFileError(name() +
                        ": this is no bag of ROS 2, or is damaged: " + sqlite3_errmsg(base_.get()));
  }
  return Statement(prepared);
}

bool Rosbag2::step(sqlite3_stmt& statement) const {
  const int result = sqlite3_step(&statement);
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) return false;
  throw ScanFileError(name() +
                      ": the bag cannot be read any further: " + sqlite3_errmsg(base_.get()));
}

bool Rosbag2::next(FileMessage& message) {
  while (!ended_) {
    try {
      ended_ = !step(*messages_);
    } catch (const ScanFileError&) {
      ended_ = true;
      throw;
    }
    if (ended_) break;
    message.place = static_cast<std::uint64_t>(sqlite3_column_int64(messages_.get(), 0));
    message.log_time = sqlite3_column_int64(messages_.get(), 2);
    if (message.log_time < skip_until_) continue;
    const auto topic = topics_.find(sqlite3_column_int64(messages_.get(), 1));
    message.topic = nullptr;
    if (topic == topics_.end()) fail(message, "a message of a topic that the bag does not have");
    ++topic->second.messages;
    message.topic = &topic->second;
    const void* data = sqlite3_column_blob(messages_.get(), 3);
    const int size = sqlite3_column_bytes(messages_.get(), 3);
    message.data = {static_cast<const char*>(data), static_cast<std::size_t>(size)};
    return true;
  }
  return false;
}

std::map<std::string, FileTopic> Rosbag2::topics() const {
  std::map<std::string, FileTopic> result;
  for (const auto& [id, topic] : topics_) result[topic.name] = topic;
  return result;
}

}  // namespace quoin::sensor_bridge
