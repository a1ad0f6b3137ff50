// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

// The records of an MCAP file (https://mcap.dev/spec), one structure each: its number, and its
// fields in the order in which they are written. mcap_codec.hpp reads and writes them by that.
namespace quoin::sensor_bridge::mcap {

inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
/// [byte] Number of the record and length of what follows.
inline constexpr std::size_t prefix_size = 9;

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

using Text = std::map<std::string, std::string>;
/// Bytes behind a length of 64 bits, and those up to the end of the record. Read, they stay where
/// they are.
struct LongBytes {
  std::string_view bytes;
};
struct Rest {
  std::string_view bytes;
};

struct Header {
  std::string profile;
  std::string library;
  static constexpr Op op = Op::header;
  static constexpr auto fields() { return std::tuple{&Header::profile, &Header::library}; }
};

struct Footer {
  std::uint64_t summary_start = 0;
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;  // from summary_start up to this field
  static constexpr Op op = Op::footer;
  static constexpr auto fields() {
    return std::tuple{&Footer::summary_start, &Footer::summary_offset_start, &Footer::summary_crc};
  }
};

struct Schema {
  std::uint16_t id = 0;  // not 0
  std::string name;
  std::string encoding;
  std::string data;
  static constexpr Op op = Op::schema;
  static constexpr auto fields() {
    return std::tuple{&Schema::id, &Schema::name, &Schema::encoding, &Schema::data};
  }
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  // 0: none
  std::string topic;
  std::string message_encoding;
  Text metadata;
  static constexpr Op op = Op::channel;
  static constexpr auto fields() {
    return std::tuple{&Channel::id, &Channel::schema_id, &Channel::topic,
                      &Channel::message_encoding, &Channel::metadata};
  }
};

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;      // [ns since the Unix epoch]
  std::uint64_t publish_time = 0;  // [ns since the Unix epoch]
  Rest data;
  static constexpr Op op = Op::message;
  static constexpr auto fields() {
    return std::tuple{&Message::channel_id, &Message::sequence, &Message::log_time,
                      &Message::publish_time, &Message::data};
  }
};

struct Chunk {
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  // 0: none
  std::string compression;
  LongBytes records;
  static constexpr Op op = Op::chunk;
  static constexpr auto fields() {
    return std::tuple{
        &Chunk::start,       &Chunk::end,    &Chunk::uncompressed_size, &Chunk::uncompressed_crc,
        &Chunk::compression, &Chunk::records};
  }
};

struct MessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> records;  // log time, offset in the chunk
  static constexpr Op op = Op::message_index;
  static constexpr auto fields() {
    return std::tuple{&MessageIndex::channel_id, &MessageIndex::records};
  }
};

struct ChunkIndex {
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::uint64_t chunk_offset = 0;
  std::uint64_t chunk_length = 0;  // with its prefix
  std::map<std::uint16_t, std::uint64_t> index_offsets;
  std::uint64_t index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
  static constexpr Op op = Op::chunk_index;
  static constexpr auto fields() {
    return std::tuple{&ChunkIndex::start,
                      &ChunkIndex::end,
                      &ChunkIndex::chunk_offset,
                      &ChunkIndex::chunk_length,
                      &ChunkIndex::index_offsets,
                      &ChunkIndex::index_length,
                      &ChunkIndex::compression,
                      &ChunkIndex::compressed_size,
                      &ChunkIndex::uncompressed_size};
  }
};

struct Attachment {
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;
  std::string name;
  std::string media_type;
  LongBytes data;
  std::uint32_t crc = 0;  // of the fields before it
  static constexpr Op op = Op::attachment;
  static constexpr auto fields() {
    return std::tuple{&Attachment::log_time,   &Attachment::create_time, &Attachment::name,
                      &Attachment::media_type, &Attachment::data,        &Attachment::crc};
  }
};

struct AttachmentIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
  static constexpr Op op = Op::attachment_index;
  static constexpr auto fields() {
    return std::tuple{&AttachmentIndex::offset,    &AttachmentIndex::length,
                      &AttachmentIndex::log_time,  &AttachmentIndex::create_time,
                      &AttachmentIndex::data_size, &AttachmentIndex::name,
                      &AttachmentIndex::media_type};
  }
};

struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::map<std::uint16_t, std::uint64_t> channel_messages;
  static constexpr Op op = Op::statistics;
  static constexpr auto fields() {
    return std::tuple{
        &Statistics::messages,    &Statistics::schemas,  &Statistics::channels,
        &Statistics::attachments, &Statistics::metadata, &Statistics::chunks,
        &Statistics::start,       &Statistics::end,      &Statistics::channel_messages};
  }
};

struct Metadata {
  std::string name;
  Text entries;
  static constexpr Op op = Op::metadata;
  static constexpr auto fields() { return std::tuple{&Metadata::name, &Metadata::entries}; }
};

struct MetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::string name;
  static constexpr Op op = Op::metadata_index;
  static constexpr auto fields() {
    return std::tuple{&MetadataIndex::offset, &MetadataIndex::length, &MetadataIndex::name};
  }
};

struct SummaryOffset {
  std::uint8_t group = 0;  // Op of the records
  std::uint64_t start = 0;
  std::uint64_t length = 0;
  static constexpr Op op = Op::summary_offset;
  static constexpr auto fields() {
    return std::tuple{&SummaryOffset::group, &SummaryOffset::start, &SummaryOffset::length};
  }
};

struct DataEnd {
  std::uint32_t crc = 0;  // of the file up to this record; 0: none
  static constexpr Op op = Op::data_end;
  static constexpr auto fields() { return std::tuple{&DataEnd::crc}; }
};

}  // namespace quoin::sensor_bridge::mcap
