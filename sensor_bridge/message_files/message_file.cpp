// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/message_file.hpp"

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/message_files/binary_file.hpp"
#include "sensor_bridge/message_files/mcap_reader.hpp"
#include "sensor_bridge/message_files/rosbag.hpp"
#include "sensor_bridge/message_files/rosbag2.hpp"

namespace quoin::sensor_bridge {

namespace {

class McapFile final : public MessageFile {
 public:
  explicit McapFile(const std::filesystem::path& file) : MessageFile(file, "byte"), reader_(file) {}

  [[nodiscard]] bool next(FileMessage& message) override {
    mcap::RecordedMessage recorded;
    if (!reader_.next(recorded)) return false;
    FileTopic& topic = topics_[recorded.channel->id];
    if (topic.name.empty()) topic = topic_of(*recorded.channel, recorded.schema);
    ++topic.messages;
    message = {&topic, static_cast<std::int64_t>(recorded.log_time), recorded.data,
               reader_.offset()};
    return true;
  }
  [[nodiscard]] std::map<std::string, FileTopic> topics() const override {
    std::map<std::string, FileTopic> result;
    for (const auto& [id, topic] : topics_) result[topic.name] = topic;
    if (const auto summary = reader_.summary()) {
      for (const auto& [id, channel] : summary->channels) {
        const auto schema = summary->schemas.find(channel.schema_id);
        FileTopic& topic = result[channel.topic];
        topic = topic_of(channel, schema == summary->schemas.end() ? nullptr : &schema->second);
        if (!summary->statistics) continue;
        const auto count = summary->statistics->channel_messages.find(id);
        if (count != summary->statistics->channel_messages.end()) topic.messages = count->second;
      }
    }
    return result;
  }
  void skip_until(std::int64_t time) override {
    reader_.skip_until(static_cast<std::uint64_t>(time));
  }
  [[nodiscard]] std::optional<double> progress() const override { return reader_.progress(); }

 private:
  static FileTopic topic_of(const mcap::Channel& channel, const mcap::Schema* schema) {
    return {channel.topic, schema == nullptr ? "" : schema->name, channel.message_encoding, 0};
  }

  mcap::Reader reader_;
  std::map<std::uint16_t, FileTopic> topics_;  // by channel
};

}  // namespace

void MessageFile::fail(const FileMessage& message, const std::string& what) const {
  throw ScanFileError(name_ + ": " + place_ + " " + std::to_string(message.place) +
                      (message.topic == nullptr ? "" : ": " + printable(message.topic->name)) +
                      ": " + what);
}

std::optional<MessageFileKind> message_file_kind(const std::filesystem::path& file) {
  const std::string begin = BinaryFile(file).beginning(16);
  if (begin.starts_with(mcap::magic)) return MessageFileKind::mcap;
  if (begin.starts_with(rosbag_magic)) return MessageFileKind::rosbag;
  if (begin.starts_with("#ROS")) {
    throw ScanFileError(file.string() + ": byte 0: a ROS bag of a format before 2.0 (" +
                        begin.substr(1, begin.find('\n') - 1) +
                        "); 'rosbag fix' makes one of 2.0 of it");
  }
  if (begin.starts_with("SQLite format 3")) return MessageFileKind::rosbag2;
  return std::nullopt;
}

std::unique_ptr<MessageFile> open_message_file(const std::filesystem::path& file) {
  const auto kind = message_file_kind(file);
  if (!kind) {
    throw ScanFileError("'" + file.string() +
                        "' is no recording of messages (MCAP, ROS 1 bag, ROS 2 bag)");
  }
  switch (*kind) {
    case MessageFileKind::mcap:
      return std::make_unique<McapFile>(file);
    case MessageFileKind::rosbag:
      return std::make_unique<Rosbag>(file);
    case MessageFileKind::rosbag2:
      break;
  }
  return std::make_unique<Rosbag2>(file);
}

}  // namespace quoin::sensor_bridge
