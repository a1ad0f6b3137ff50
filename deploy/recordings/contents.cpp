// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/recordings/contents.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/text/printable.hpp"
#include "sensor_bridge/message_files/mcap_reader.hpp"

namespace quoin::deploy {

namespace {

namespace mcap = sensor_bridge::mcap;
using sensor_bridge::FileTopic;
using sensor_bridge::ScanFileError;

constexpr std::uint64_t messages_between_reports = 1000;

std::string utc_text(std::int64_t time) {
  const std::time_t seconds = time / 1'000'000'000;
  std::tm fields{};
  ::gmtime_r(&seconds, &fields);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &fields);
  std::array<char, 16> rest{};
  std::snprintf(rest.data(), rest.size(), ".%03d UTC", static_cast<int>(time / 1'000'000 % 1000));
  return std::string(text.data()) + rest.data();
}

/// What is known without reading the messages.
void add_summary(const mcap::Reader& reader, const mcap::Summary& summary, Contents& contents) {
  for (const mcap::MetadataIndex& index : summary.metadata) {
    const mcap::Metadata metadata = reader.metadata_at(index);
    contents.metadata[metadata.name] = metadata.entries;
  }
  for (const mcap::AttachmentIndex& index : summary.attachments) {
    contents.attachments.push_back(index.name);
  }
  if (!summary.statistics) return;
  contents.messages = summary.statistics->messages;
  contents.start = static_cast<std::int64_t>(summary.statistics->start);
  contents.end = static_cast<std::int64_t>(summary.statistics->end);
}

/// Empty when what the end of the file says is what its messages are.
std::string contradiction(const mcap::Reader& reader, const mcap::Summary& summary) {
  if (summary.statistics) {
    if (summary.statistics->channel_messages != reader.counts()) {
      return "the statistics do not count the messages that are in the file";
    }
  }
  if (summary.chunks.empty()) return "";
  const auto place = [](const mcap::ChunkIndex& chunk) {
    return std::tuple(chunk.chunk_offset, chunk.chunk_length, chunk.start, chunk.end,
                      chunk.uncompressed_size);
  };
  const auto& chunks = reader.chunks();
  if (!std::ranges::equal(chunks, summary.chunks, {}, place, place)) {
    return "the index does not name the chunks that are in the file";
  }
  return "";
}

std::string check_mcap(const std::filesystem::path& file) {
  try {
    mcap::Reader reader(file);
    mcap::RecordedMessage message;
    while (reader.next(message)) {
    }
    const auto summary = reader.summary();
    if (!summary) return file.string() + ": there is no summary at its end";
    const std::string text = contradiction(reader, *summary);
    if (!text.empty()) return file.string() + ": " + text;
    for (const mcap::AttachmentIndex& index : summary->attachments) {
      (void)reader.attachment_at(index);
    }
    return "";
  } catch (const ScanFileError& error) {
    return error.what();
  }
}

void read_messages(const std::filesystem::path& file, Contents& contents,
                   const std::function<void(std::uint64_t messages)>& progress) {
  const auto messages = sensor_bridge::open_message_file(file);
  sensor_bridge::FileMessage message;
  contents.messages = 0;
  try {
    while (messages->next(message)) {
      contents.start =
          contents.messages == 0 ? message.log_time : std::min(contents.start, message.log_time);
      contents.end = std::max(contents.end, message.log_time);
      if (++contents.messages % messages_between_reports == 0) progress(contents.messages);
    }
  } catch (const ScanFileError& error) {
    contents.damage = error.what();
  }
  contents.topics = messages->topics();
}

}  // namespace

Contents read_contents(const std::filesystem::path& file, bool thorough,
                       const std::function<void(std::uint64_t messages)>& progress) {
  constexpr std::array formats{"MCAP", "ROS 1 bag", "ROS 2 bag (SQLite)"};
  Contents contents;
  const auto kind = sensor_bridge::message_file_kind(file);
  if (!kind) {
    throw ScanFileError("'" + file.string() +
                        "' is no recording of messages (MCAP, ROS 1 bag, ROS 2 bag)");
  }
  contents.format = formats[static_cast<std::size_t>(*kind)];
  contents.bytes = std::filesystem::file_size(file);
  if (*kind != sensor_bridge::MessageFileKind::mcap) {
    read_messages(file, contents, progress);
    return contents;
  }
  const mcap::Reader reader(file);
  std::optional<mcap::Summary> summary;
  try {
    summary = reader.summary();
    if (summary) add_summary(reader, *summary, contents);
  } catch (const ScanFileError& error) {
    contents.damage = error.what();
  }
  if (summary && summary->statistics && !thorough) {
    contents.topics = sensor_bridge::open_message_file(file)->topics();
    return contents;
  }
  const std::string damage = contents.damage;
  try {
    read_messages(file, contents, progress);
  } catch (const ScanFileError&) {
    // Of the summary, which has been told.
  }
  if (contents.damage.empty()) contents.damage = damage;
  if (contents.damage.empty() && thorough) contents.damage = check_mcap(file);
  return contents;
}

std::vector<std::string> contents_lines(const Contents& contents) {
  std::vector<std::string> lines;
  std::array<char, 64> duration{};
  std::snprintf(duration.data(), duration.size(), "%.3f s",
                static_cast<double>(contents.end - contents.start) * 1e-9);
  lines.push_back(contents.format + ", " + std::to_string(contents.bytes) + " bytes, " +
                  std::to_string(contents.messages) + " messages");
  if (contents.messages > 0) {
    lines.push_back(utc_text(contents.start) + ", " + duration.data());
  }
  std::size_t widest = 0;
  for (const auto& [name, topic] : contents.topics) widest = std::max(widest, name.size());
  for (const auto& [name, topic] : contents.topics) {
    std::array<char, 16> count{};
    std::snprintf(count.data(), count.size(), "%8llu",
                  static_cast<unsigned long long>(topic.messages));
    lines.push_back(std::string(count.data()) + "  " + name +
                    std::string(widest - name.size() + 2, ' ') + topic.type + " (" +
                    topic.encoding + ")");
  }
  for (const auto& [name, entries] : contents.metadata) {
    for (const auto& [key, value] : entries) {
      lines.push_back(name + ": " + key + ": " + value);
    }
  }
  for (const std::string& name : contents.attachments) lines.push_back("attachment: " + name);
  for (std::string& line : lines) line = printable(line);
  return lines;
}

nlohmann::ordered_json contents_json(const Contents& contents) {
  nlohmann::ordered_json object;
  object["format"] = contents.format;
  object["bytes"] = contents.bytes;
  object["messages"] = contents.messages;
  object["start_ns"] = contents.start;
  object["end_ns"] = contents.end;
  auto topics = nlohmann::ordered_json::object();
  for (const auto& [name, topic] : contents.topics) {
    topics[name] = {
        {"type", topic.type}, {"encoding", topic.encoding}, {"messages", topic.messages}};
  }
  object["topics"] = topics;
  object["metadata"] = contents.metadata;
  object["attachments"] = contents.attachments;
  if (!contents.damage.empty()) object["damage"] = contents.damage;
  return object;
}

}  // namespace quoin::deploy
