// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sensor_bridge/message_files/mcap_writer.hpp"
#include "services/recorder/parameters.hpp"
#include "services/topics/protobuf/message_encoder.hpp"
#include "services/topics/protobuf/views.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin {

/// When a recording goes on in a new file.
struct Split {
  double seconds = 0.0;     ///< 0: never by time
  std::uint64_t bytes = 0;  ///< 0: never by size
};
/// "10min", "1 h", "90s", "500MB", "1 GB" or "". Throws ParameterError.
[[nodiscard]] Split parse_split(std::string_view text);

/// The file that a recording to `path` begins with: itself, or in a folder one of the present time.
/// Throws ParameterError for a file of another format.
[[nodiscard]] std::filesystem::path recording_file(const std::filesystem::path& path);

/// A topic to record.
struct RecordedTopic {
  std::string topic;
  std::string service;
  const topics::TopicType* type = nullptr;
  std::string qos;  ///< preset
};

/// Heartbeats are recorded like the types of the table, but have no Protobuf of ours.
inline constexpr topics::TopicType heartbeat_type{"status", "quoin::msg::ServiceStatus", "state",
                                                  "Status.idl"};

/// A message to record.
struct MessageToRecord {
  std::size_t topic = 0;  ///< index of the topic
  std::vector<std::byte> cdr;
  std::string frame;
  std::int64_t stamp = 0;
  std::uint64_t sequence_number = 0;
  std::int64_t published = 0;  ///< [ns since the Unix epoch]
  std::int64_t received = 0;   ///< [ns since the Unix epoch]
};

/// What a file says of the run beside its messages: metadata records by name, and the text of the
/// deployment.
struct RunFacts {
  std::map<std::string, std::map<std::string, std::string>> metadata;
  std::string deployment_name;
  std::string deployment_text;
};

/// The files of a recording. One thread uses it.
class Recording {
 public:
  /// `path`: as in RecorderParameters, but absolute or relative to the working directory. Throws
  /// ParameterError or mcap::WriteError.
  Recording(const std::filesystem::path& path, const RecorderParameters& parameters,
            std::vector<RecordedTopic> topics, RunFacts facts);

  /// Throws mcap::WriteError; then only finish() may follow.
  void write(const MessageToRecord& message);
  /// What was written survives the end of the process from now on. Throws mcap::WriteError, also
  /// when the disk has less room than it should keep.
  void flush();
  /// Closes the file; `last` is added to its metadata.
  void finish(const std::map<std::string, std::map<std::string, std::string>>& last);

  [[nodiscard]] const std::filesystem::path& file() const { return writer_->path(); }
  /// Files that are closed, in their order.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  /// [byte] over all files
  [[nodiscard]] std::uint64_t size() const { return finished_size_ + writer_->size(); }
  /// Messages of the topics that were lost because the disk took no more.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  struct Channels {
    std::uint16_t cdr = 0;  // 0: not yet
    std::uint16_t protobuf = 0;
    std::vector<std::uint16_t> views;
  };
  struct Topic {
    RecordedTopic described;
    std::optional<topics::MessageEncoder> encoder;
    topics::Views views;
    Channels channels;
    // By key, of a topic whose newest messages late readers get.
    std::map<std::string, MessageToRecord> last;
  };

  void open();
  void split_if_due(std::int64_t now);
  void write_to_file(Topic& topic, const MessageToRecord& message, std::int64_t log_time);
  [[nodiscard]] static std::string key_of(const Topic& topic, const MessageToRecord& message);
  void write_frame(const MessageToRecord& message, std::int64_t log_time);
  [[nodiscard]] std::uint16_t schema(std::string_view name, std::string_view encoding,
                                     std::string_view idl = {});
  void check_room() const;

  RecorderParameters parameters_;
  std::filesystem::path base_;
  Split split_;
  std::vector<Topic> topics_;
  RunFacts facts_;
  std::unique_ptr<sensor_bridge::mcap::Writer> writer_;
  std::vector<std::filesystem::path> files_;
  int number_ = 0;                                // of the file that is open, from 1
  std::map<std::string, std::uint16_t> schemas_;  // of the file, by encoding and name
  std::uint16_t transforms_ = 0;                  // channel
  std::set<std::string, std::less<>> frames_;     // that the file says where they are
  std::int64_t opened_at_ = 0;                    // [ns] log time of the first message; 0: none
  std::uint64_t finished_size_ = 0;
  std::uint64_t dropped_ = 0;
  std::string buffer_;
};

}  // namespace quoin
