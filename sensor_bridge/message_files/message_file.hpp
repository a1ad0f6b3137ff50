// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sensor_bridge/message_files/scan_file_error.hpp"

namespace quoin::sensor_bridge {

/// A topic of a recording of messages.
struct FileTopic {
  std::string name;
  std::string type;      ///< as the file has it: "sensor_msgs/msg/LaserScan"
  std::string encoding;  ///< of the messages: cdr, ros1, protobuf, json ...
  std::uint64_t messages = 0;
};

/// A message of a recording.
struct FileMessage {
  const FileTopic* topic = nullptr;
  std::int64_t log_time = 0;  ///< [ns since the Unix epoch] of its recording
  std::string_view data;      ///< valid until the next message is read
  std::uint64_t place = 0;    ///< for errors: byte of the file, or row of a data base
};

/// How a recording of messages is written.
enum class MessageFileKind { mcap, rosbag, rosbag2 };

/// By the first bytes of a file; nothing for one that is no recording of messages. Throws
/// ScanFileError for a file that cannot be read, and for a bag of a format before 2.0.
[[nodiscard]] std::optional<MessageFileKind> message_file_kind(const std::filesystem::path& file);

/// A recording of messages of whatever kind, read from its beginning.
class MessageFile {
 public:
  virtual ~MessageFile() = default;
  MessageFile(const MessageFile&) = delete;
  MessageFile& operator=(const MessageFile&) = delete;

  /// The next message in the order of the file; false at the end. Throws ScanFileError at what is
  /// damaged, once all messages before have been given; nothing follows then.
  [[nodiscard]] virtual bool next(FileMessage& message) = 0;
  /// All topics, as far as the file says so before its messages are read, and those seen so far.
  [[nodiscard]] virtual std::map<std::string, FileTopic> topics() const = 0;
  /// Messages before this time [ns since the Unix epoch] may be left out.
  virtual void skip_until(std::int64_t time) = 0;
  /// How much of the file is read, 0 to 1; nothing where that is not known.
  [[nodiscard]] virtual std::optional<double> progress() const { return std::nullopt; }
  /// Throws ScanFileError for a message.
  [[noreturn]] void fail(const FileMessage& message, const std::string& what) const;

 protected:
  explicit MessageFile(const std::filesystem::path& file, const char* place)
      : name_(file.string()), place_(place) {}
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  const char* place_;  // what FileMessage::place counts
};

/// Opens a recording of any kind. Throws ScanFileError.
[[nodiscard]] std::unique_ptr<MessageFile> open_message_file(const std::filesystem::path& file);

}  // namespace quoin::sensor_bridge
