// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/message_scans.hpp"

#include <map>
#include <optional>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/message_files/message_file.hpp"
#include "sensor_bridge/recordings/laser_scan_message.hpp"

namespace quoin::sensor_bridge {

namespace {

class MessageScans final : public ScanReader {
 public:
  MessageScans(const std::filesystem::path& file, const std::string& topic, double start)
      : name_(file.string()), file_(open_message_file(file)), start_(start) {
    topic_ = topic.empty() ? only_topic(file) : topic;
  }

  bool next(RecordedScan& scan) override {
    while (file_->next(message_)) {
      if (!first_time_) first_time_ = message_.log_time;
      if (message_.topic->name != topic_) continue;
      if (static_cast<double>(message_.log_time - *first_time_) * 1e-9 < start_) continue;
      const auto kind = scan_message(message_.topic->type, message_.topic->encoding);
      if (!kind) fail("topic '" + topic_ + "' holds no scans, but " + message_.topic->type);
      const std::string wrong = read_scan_message(*kind, message_.data, scan);
      if (!wrong.empty()) file_->fail(message_, wrong);
      return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& what) const override {
    throw ScanFileError(name_ + ": " + what + topics_text(file_->topics()));
  }

 private:
  /// Reads the whole file where its topics do not stand at its end.
  static std::string only_topic(const std::filesystem::path& path) {
    const auto file = open_message_file(path);
    auto topics = file->topics();
    if (topics.empty()) {
      FileMessage message;
      try {
        while (file->next(message)) {
        }
      } catch (const ScanFileError&) {
        // Told when the scans before it have been read.
      }
      topics = file->topics();
    }
    std::string found;
    for (const auto& [name, topic] : topics) {
      if (!scan_message(topic.type, topic.encoding)) continue;
      if (!found.empty()) {
        throw ScanFileError(path.string() + ": several topics hold scans; name one with 'topic'" +
                            topics_text(topics));
      }
      found = name;
    }
    if (found.empty()) {
      throw ScanFileError(path.string() + ": no topic holds scans" + topics_text(topics));
    }
    return found;
  }

  static std::string topics_text(const std::map<std::string, FileTopic>& topics) {
    if (topics.empty()) return "; the file has no topics";
    std::string text = "; its topics are ";
    for (const auto& [name, topic] : topics) {
      text += (name == topics.begin()->first ? "" : ", ") + name + " (" + topic.type +
              (topic.encoding == "cdr" || topic.encoding == "ros1" ? "" : " as " + topic.encoding) +
              ")";
    }
    return printable(text);
  }

  std::string name_;
  std::unique_ptr<MessageFile> file_;
  std::string topic_;
  double start_;
  std::optional<std::int64_t> first_time_;
  FileMessage message_;
};

}  // namespace

std::unique_ptr<ScanReader> open_message_scans(const std::filesystem::path& file,
                                               const std::string& topic, double start) {
  return std::make_unique<MessageScans>(file, topic, start);
}

}  // namespace quoin::sensor_bridge
