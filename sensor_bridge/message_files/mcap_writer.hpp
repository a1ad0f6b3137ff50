// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sensor_bridge/message_files/compression.hpp"
#include "sensor_bridge/message_files/mcap_records.hpp"

namespace quoin::sensor_bridge::mcap {

/// The disk took no more, or the file cannot be written. What was flushed before is in the file.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct WriterOptions {
  Compression compression = Compression::zstd;
  std::size_t chunk_size = std::size_t{1} << 20U;  ///< [byte] of messages before a chunk is written
  std::string profile = {};
  std::string library = "quoin";
};

/// Writes an MCAP file with chunks, message indexes, checksums, a summary and statistics. Until
/// finish() the file is called <path>.part; what was flushed survives the end of the process.
class Writer {
 public:
  /// Throws WriteError when the file cannot be made, or <path> or <path>.part are there already.
  Writer(const std::filesystem::path& path, WriterOptions options);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Both return the number of what was added, and throw WriteError.
  [[nodiscard]] std::uint16_t add_schema(const std::string& name, const std::string& encoding,
                                         const std::string& data);
  /// `schema` 0: messages without one.
  [[nodiscard]] std::uint16_t add_channel(std::uint16_t schema, const std::string& topic,
                                          const std::string& encoding, const Text& metadata = {});
  void add_metadata(const std::string& name, const Text& entries);
  void add_attachment(const std::string& name, const std::string& media_type, std::string_view data,
                      std::uint64_t time);

  /// Adds the message to the chunk that is being filled, which is flushed when it is full. Throws
  /// WriteError, as flush() does.
  void write(const Message& message);
  /// Writes what was added to the file. On WriteError the file is as it was before; the messages of
  /// the chunk are lost, and count in dropped().
  void flush();
  /// Writes the summary and gives the file its name. When the disk has no room for that, chunks go,
  /// last first, until there is. Throws WriteError.
  void finish();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// [byte] of the file and of the chunk that is being filled
  [[nodiscard]] std::uint64_t size() const { return offset_ + chunk_.size(); }
  /// Messages in the file or in the chunk that is being filled.
  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] bool chunk_empty() const { return chunk_.empty(); }

 private:
  struct WrittenChunk {
    ChunkIndex index;
    std::map<std::uint16_t, std::uint64_t> messages;  // by channel
    std::uint32_t crc_before = 0;                     // of the file up to it
  };

  void append(std::string_view bytes);
  void truncate(std::uint64_t offset, std::uint32_t crc);
  void drop_last_chunk();
  [[nodiscard]] std::string summary() const;
  [[noreturn]] void fail(const std::string& what, int error) const;

  std::filesystem::path path_;
  std::filesystem::path part_;
  WriterOptions options_;
  int descriptor_ = -1;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<MetadataIndex> metadata_;
  std::vector<AttachmentIndex> attachments_;
  std::vector<WrittenChunk> chunks_;
  std::string chunk_;  // records that are not written yet
  std::map<std::uint16_t, MessageIndex> index_;
  std::uint64_t start_ = 0;
  std::uint64_t end_ = 0;
  std::uint64_t messages_ = 0;
  std::uint64_t dropped_ = 0;
  std::string compressed_;
  std::string record_;
};

}  // namespace quoin::sensor_bridge::mcap
