// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sensor_bridge/message_files/binary_file.hpp"
#include "sensor_bridge/message_files/mcap_records.hpp"

namespace quoin::sensor_bridge::mcap {

/// A message as the file has it.
struct RecordedMessage {
  const Channel* channel = nullptr;
  const Schema* schema = nullptr;  ///< null when the channel has none
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;      ///< [ns since the Unix epoch]
  std::uint64_t publish_time = 0;  ///< [ns since the Unix epoch]
  std::string_view data;           ///< valid until the next message is read
};

/// What the end of a file says about it.
struct Summary {
  std::optional<Statistics> statistics;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<ChunkIndex> chunks;
  std::vector<AttachmentIndex> attachments;
  std::vector<MetadataIndex> metadata;
};

/// Reads an MCAP file from its beginning, message after message in the order of the file; needs no
/// index. Every length is checked, every checksum compared, and memory is bounded by one chunk.
class Reader {
 public:
  /// Throws ScanFileError when the file cannot be read or is no MCAP file.
  explicit Reader(const std::filesystem::path& file);

  /// The next message; false at the end. Throws ScanFileError at what is damaged, with the place;
  /// all messages before have been given, and resume() may find more behind.
  [[nodiscard]] bool next(RecordedMessage& message);
  /// After an error: goes on behind what is damaged. False when there is nothing more to be found.
  [[nodiscard]] bool resume();
  /// Chunks that end before this time [ns since the Unix epoch] are passed over.
  void skip_until(std::uint64_t time) { skip_until_ = time; }

  [[nodiscard]] const BinaryFile& file() const { return file_; }
  [[nodiscard]] const Header& header() const { return header_; }
  /// What was read so far.
  [[nodiscard]] const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  [[nodiscard]] const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::vector<Metadata>& metadata() const { return metadata_; }
  [[nodiscard]] const std::vector<ChunkIndex>& chunks() const { return chunks_; }
  [[nodiscard]] const std::map<std::uint16_t, std::uint64_t>& counts() const { return counts_; }
  /// [byte] of the record that is read next, or of the chunk that is being read
  [[nodiscard]] std::uint64_t offset() const { return record_offset_; }
  /// How much of the file is read, 0 to 1.
  [[nodiscard]] double progress() const {
    return static_cast<double>(record_offset_) / static_cast<double>(file_.size());
  }
  /// Whether the end of the data was reached as the format wants it.
  [[nodiscard]] bool complete() const { return complete_; }

  /// What the end of the file says, compared with its checksum; nothing when it says nothing.
  /// Independent of next(). Throws ScanFileError.
  [[nodiscard]] std::optional<Summary> summary() const;
  /// The entries of a metadata record of the summary.
  [[nodiscard]] Metadata metadata_at(const MetadataIndex& index) const;
  [[nodiscard]] std::string attachment_at(const AttachmentIndex& index) const;

 private:
  struct Prefix {
    Op op;
    std::uint64_t length;
  };

  [[nodiscard]] Prefix prefix_at(std::uint64_t offset) const;
  void read_top_level();
  void read_fields(const Prefix& prefix);
  void pass_over(const Prefix& prefix);
  void open_chunk(std::uint64_t length);
  void check_index(std::string_view bytes) const;
  void check_data_end(std::string_view bytes) const;
  [[nodiscard]] bool next_in_chunk(RecordedMessage& message);
  void add_schema(std::string_view bytes);
  void add_channel(std::string_view bytes);
  [[nodiscard]] RecordedMessage message_of(std::string_view bytes);
  [[noreturn]] void fail(const std::string& what) const { file_.fail(record_offset_, what); }

  BinaryFile file_;
  Header header_;
  std::uint64_t offset_ = 0;         // of the next record
  std::uint64_t record_offset_ = 0;  // of the one being read
  std::string bytes_;                // of it
  std::string chunk_;                // records of the chunk being read
  std::size_t in_chunk_ = 0;
  bool chunk_open_ = false;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<Metadata> metadata_;
  std::vector<ChunkIndex> chunks_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::uint64_t skip_until_ = 0;
  std::uint32_t crc_ = 0;  // of the file up to offset_
  bool crc_known_ = true;  // nothing was passed over
  bool complete_ = false;
  bool lost_ = false;  // nothing more can be found
};

}  // namespace quoin::sensor_bridge::mcap
