// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/rosbag.hpp"

#include <cstring>
#include <limits>
#include <optional>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/message_files/compression.hpp"

namespace quoin::sensor_bridge {

namespace {

constexpr std::uint32_t largest_header = 1U << 20U;  // [byte]
enum RosbagOp : std::uint8_t { message_op = 2, chunk_op = 5, connection_op = 7 };

std::uint32_t u32(std::string_view bytes) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// Takes a length and as many bytes from the front; nothing when they are not there.
std::optional<std::string_view> take_field(std::string_view& bytes) {
  if (bytes.size() < 4) return std::nullopt;
  const std::uint32_t length = u32(bytes);
  if (bytes.size() - 4 < length) return std::nullopt;
  const std::string_view field = bytes.substr(4, length);
  bytes.remove_prefix(4 + std::size_t{length});
  return field;
}

}  // namespace

Rosbag::Rosbag(const std::filesystem::path& file)
    : MessageFile(file, "byte"), file_(file), offset_(rosbag_magic.size()) {}

/// The record at `offset` to bytes_; false at the end of the file.
bool Rosbag::read_record(std::uint64_t offset) {
  if (offset == file_.size()) return false;
  std::string length;
  file_.read(offset, 4, length);
  const std::uint32_t header = u32(length);
  if (header > largest_header) file_.fail(offset, "no record begins here; the bag is damaged");
  file_.read(offset + 4 + header, 4, length);
  const std::uint32_t data = u32(length);
  if (data > largest_chunk) {
    file_.fail(offset, "a record of " + std::to_string(data) + " bytes, more than the " +
                           std::to_string(largest_chunk) + " that it may have");
  }
  file_.read(offset, 8 + std::size_t{header} + data, bytes_);
  return true;
}

Rosbag::Record Rosbag::parse(std::string_view bytes) const {
  Record record;
  const std::size_t size = bytes.size();
  auto header = take_field(bytes);
  const auto data = take_field(bytes);
  if (!header || !data) file_.fail(record_offset_, "a record goes beyond its chunk");
  record.data = *data;
  record.size = size - bytes.size();
  while (!header->empty()) {
    const auto field = take_field(*header);
    const std::size_t equals = field ? field->find('=') : std::string_view::npos;
    if (equals == std::string_view::npos) {
      file_.fail(record_offset_, "the header of a record is damaged");
    }
    record.header[field->substr(0, equals)] = field->substr(equals + 1);
  }
  return record;
}

template <class T>
T Rosbag::number(const Fields& header, std::string_view name) const {
  const auto field = header.find(name);
  if (field == header.end() || field->second.size() != sizeof(T)) {
    file_.fail(record_offset_, "a record has no " + std::string(name) + "; the bag is damaged");
  }
  T value{};
  std::memcpy(&value, field->second.data(), sizeof(T));
  return value;
}

bool Rosbag::next(FileMessage& message) {
  while (true) {
    while (in_chunk_ < chunk_.size()) {
      const Record record = parse(std::string_view(chunk_).substr(in_chunk_));
      in_chunk_ += record.size;
      const auto op = number<std::uint8_t>(record.header, "op");
      if (op == connection_op) add_connection(record);
      if (op == message_op && message_of(record, message)) return true;
    }
    record_offset_ = offset_;
    if (!read_record(offset_)) return false;
    const Record record = parse(bytes_);
    offset_ += record.size;
    switch (number<std::uint8_t>(record.header, "op")) {
      case chunk_op:
        open_chunk(record);
        break;
      case connection_op:
        add_connection(record);
        break;
      case message_op:  // not in a chunk
        if (message_of(record, message)) return true;
        break;
      default:
        break;
    }
  }
}

void Rosbag::add_connection(const Record& record) {
  const auto id = number<std::uint32_t>(record.header, "conn");
  Fields fields;
  std::string_view left = record.data;
  while (!left.empty()) {
    const auto field = take_field(left);
    const std::size_t equals = field ? field->find('=') : std::string_view::npos;
    if (equals == std::string_view::npos) file_.fail(record_offset_, "a connection is damaged");
    fields[field->substr(0, equals)] = field->substr(equals + 1);
  }
  FileTopic& topic = connections_[id];
  const auto name = record.header.find("topic");
  topic.name = name == record.header.end() ? std::string(fields["topic"]) : name->second;
  topic.type = fields["type"];
  topic.encoding = "ros1";
}

void Rosbag::open_chunk(const Record& record) {
  const auto field = record.header.find("compression");
  const std::string_view name = field == record.header.end() ? "" : field->second;
  const auto compression = compression_of(name);
  if (!compression) {
    file_.fail(record_offset_, "a chunk is compressed as " + excerpt(name) +
                                   "; none, bz2 and lz4 are known (a bag that is encrypted cannot "
                                   "be read)");
  }
  try {
    decompress(*compression, record.data, number<std::uint32_t>(record.header, "size"), chunk_);
  } catch (const CompressionError& error) {
    chunk_.clear();
    file_.fail(record_offset_, std::string("a chunk cannot be decompressed: ") + error.what());
  }
  in_chunk_ = 0;
}

bool Rosbag::message_of(const Record& record, FileMessage& message) {
  const auto connection = connections_.find(number<std::uint32_t>(record.header, "conn"));
  if (connection == connections_.end()) {
    file_.fail(record_offset_, "a message of a connection that is not described before it");
  }
  const auto time = number<std::uint64_t>(record.header, "time");
  const std::int64_t log_time = static_cast<std::int64_t>(time & 0xFFFF'FFFFU) * 1'000'000'000 +
                                static_cast<std::int64_t>(time >> 32U);
  if (log_time < skip_until_) return false;
  ++connection->second.messages;
  message = {&connection->second, log_time, record.data, record_offset_};
  return true;
}

std::map<std::string, FileTopic> Rosbag::topics() const {
  std::map<std::string, FileTopic> result;
  for (const auto& [id, topic] : connections_) {
    const auto [entry, added] = result.try_emplace(topic.name, topic);
    if (!added) entry->second.messages += topic.messages;
  }
  return result;
}

}  // namespace quoin::sensor_bridge
