// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/mcap_reader.hpp"

#include <algorithm>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/message_files/compression.hpp"
#include "sensor_bridge/message_files/mcap_codec.hpp"

namespace quoin::sensor_bridge::mcap {

namespace {

// More than any record needs but chunks and attachments.
constexpr std::uint64_t largest_record = std::uint64_t{64} << 20U;  // [byte]
constexpr std::size_t piece = std::size_t{1} << 20U;                // [byte]
constexpr const char* recover_hint =
    "'quoin recording recover' makes a whole file of what is before";

std::string hexadecimal(std::uint8_t op) {
  constexpr const char* digits = "0123456789abcdef";
  return std::string("0x") + digits[op >> 4U] + digits[op & 15U];
}

}  // namespace

Reader::Reader(const std::filesystem::path& file) : file_(file) {
  if (!file_.holds(0, magic.size()) || file_.beginning(magic.size()) != magic) {
    file_.fail(0, "this is no MCAP file: it does not begin like one");
  }
  crc_ = crc_of(magic);
  offset_ = magic.size();
  record_offset_ = offset_;
  const Prefix prefix = prefix_at(offset_);
  if (prefix.op != Op::header) fail("the file does not begin with a header");
  read_fields(prefix);
  if (!read_record(std::string_view(bytes_), header_)) fail("the header is damaged");
}

Reader::Prefix Reader::prefix_at(std::uint64_t offset) const {
  if (!file_.holds(offset, prefix_size)) {
    file_.fail(offset, std::string("the file ends here without its summary; it was cut off, or is "
                                   "still being written: ") +
                           recover_hint);
  }
  std::string bytes;
  file_.read(offset, prefix_size, bytes);
  Prefix prefix{static_cast<Op>(bytes[0]), 0};
  std::memcpy(&prefix.length, bytes.data() + 1, sizeof prefix.length);
  if (!file_.holds(offset + prefix_size, prefix.length)) {
    file_.fail(offset, "a record of " + std::to_string(prefix.length) +
                           " bytes goes beyond the end of the file, which was cut off or is "
                           "damaged: " +
                           recover_hint);
  }
  return prefix;
}

/// The fields of the record at offset_ to bytes_.
void Reader::read_fields(const Prefix& prefix) {
  const std::uint64_t most = prefix.op == Op::chunk ? largest_chunk + piece : largest_record;
  if (prefix.length > most) {
    fail("a record of " + std::to_string(prefix.length) + " bytes, more than the " +
         std::to_string(most) + " that it may have");
  }
  file_.read(offset_, prefix_size + prefix.length, bytes_);
  crc_ = crc_of(bytes_, crc_);
  bytes_.erase(0, prefix_size);
  offset_ += prefix_size + prefix.length;
}

/// Records that are not needed, only their checksum.
void Reader::pass_over(const Prefix& prefix) {
  const std::uint64_t end = offset_ + prefix_size + prefix.length;
  while (offset_ < end) {
    file_.read(offset_, static_cast<std::size_t>(std::min<std::uint64_t>(piece, end - offset_)),
               bytes_);
    crc_ = crc_of(bytes_, crc_);
    offset_ += bytes_.size();
  }
}

bool Reader::next(RecordedMessage& message) {
  while (true) {
    if (chunk_open_) {
      if (next_in_chunk(message)) return true;
      chunk_open_ = false;
    }
    if (complete_ || lost_) return false;
    record_offset_ = offset_;
    const Prefix prefix = [&] {
      try {
        return prefix_at(offset_);
      } catch (const ScanFileError&) {
        lost_ = true;
        throw;
      }
    }();
    switch (prefix.op) {
      case Op::message:
        read_fields(prefix);
        message = message_of(bytes_);
        return true;
      case Op::chunk: {
        std::uint64_t times[2] = {};
        if (prefix.length < sizeof times) fail("a chunk is too short");
        file_.read(offset_ + prefix_size, sizeof times, bytes_);
        std::memcpy(times, bytes_.data(), sizeof times);
        if (times[1] < skip_until_) {
          offset_ += prefix_size + prefix.length;
          crc_known_ = false;
          chunk_messages_.clear();
          break;
        }
        read_fields(prefix);
        open_chunk(prefix_size + prefix.length);
        break;
      }
      case Op::attachment:
      case Op::chunk_index:
      case Op::attachment_index:
      case Op::metadata_index:
        pass_over(prefix);
        break;
      case Op::data_end: {
        const std::uint32_t crc = crc_;
        read_fields(prefix);
        crc_ = crc;
        check_data_end(bytes_);
        complete_ = true;
        return false;
      }
      default:
        read_top_level();
    }
  }
}

void Reader::read_top_level() {
  const Prefix prefix = prefix_at(offset_);
  switch (prefix.op) {
    case Op::schema:
      read_fields(prefix);
      return add_schema(bytes_);
    case Op::channel:
      read_fields(prefix);
      return add_channel(bytes_);
    case Op::metadata: {
      read_fields(prefix);
      Metadata metadata;
      if (!read_record(std::string_view(bytes_), metadata)) fail("a metadata record is damaged");
      metadata_.push_back(std::move(metadata));
      return;
    }
    case Op::message_index:
      read_fields(prefix);
      return check_index(bytes_);
    case Op::footer:
      lost_ = true;
      fail("the data ends without its last record");
    default:
      // Numbers from 0x80 on are private; others belong to later versions.
      if (static_cast<std::uint8_t>(prefix.op) == 0) {
        lost_ = true;
        fail("no record begins here; the file is damaged: " + std::string(recover_hint));
      }
      pass_over(prefix);
  }
}

void Reader::open_chunk(std::uint64_t length) {
  Chunk chunk;
  if (!read_record(std::string_view(bytes_), chunk)) fail("a chunk is damaged");
  const std::optional<Compression> compression = compression_of(chunk.compression);
  if (!compression) {
    fail("a chunk is compressed as " + excerpt(chunk.compression) + "; zstd and lz4 are known");
  }
  try {
    decompress(*compression, chunk.records.bytes, chunk.uncompressed_size, chunk_);
  } catch (const CompressionError& error) {
    fail(std::string("a chunk cannot be decompressed: ") + error.what());
  }
  if (chunk.uncompressed_crc != 0 && crc_of(chunk_) != chunk.uncompressed_crc) {
    fail("the checksum of a chunk is wrong; it is damaged");
  }
  chunks_.push_back({chunk.start,
                     chunk.end,
                     record_offset_,
                     length,
                     {},
                     0,
                     chunk.compression,
                     chunk.records.bytes.size(),
                     chunk.uncompressed_size});
  chunk_messages_.clear();
  in_chunk_ = 0;
  chunk_open_ = true;
}

bool Reader::next_in_chunk(RecordedMessage& message) {
  while (in_chunk_ < chunk_.size()) {
    const std::string_view left = std::string_view(chunk_).substr(in_chunk_);
    std::uint64_t length = 0;
    if (left.size() >= prefix_size) std::memcpy(&length, left.data() + 1, sizeof length);
    if (left.size() < prefix_size || length > left.size() - prefix_size) {
      chunk_open_ = false;
      fail("a record in the chunk here goes beyond its end");
    }
    const std::string_view fields = left.substr(prefix_size, length);
    const std::size_t at = in_chunk_;
    in_chunk_ += prefix_size + length;
    switch (static_cast<Op>(left[0])) {
      case Op::schema:
        add_schema(fields);
        break;
      case Op::channel:
        add_channel(fields);
        break;
      case Op::message:
        message = message_of(fields);
        chunk_messages_[message.channel->id].emplace_back(message.log_time, at);
        return true;
      default:
        break;
    }
  }
  return false;
}

void Reader::add_schema(std::string_view bytes) {
  Schema schema;
  if (!read_record(bytes, schema)) fail("a schema is damaged");
  if (schema.id == 0) return;  // for readers to ignore
  const auto [known, added] = schemas_.try_emplace(schema.id, schema);
  if (!added && (known->second.name != schema.name || known->second.data != schema.data)) {
    fail("schema " + std::to_string(schema.id) + " is declared twice: as " +
         excerpt(known->second.name) + " and as " + excerpt(schema.name) +
         (known->second.name == schema.name ? " with other fields" : ""));
  }
}

void Reader::add_channel(std::string_view bytes) {
  Channel channel;
  if (!read_record(bytes, channel)) fail("a channel is damaged");
  if (channel.schema_id != 0 && !schemas_.contains(channel.schema_id)) {
    fail("channel " + excerpt(channel.topic) + " has a schema that is not declared");
  }
  const auto [known, added] = channels_.try_emplace(channel.id, channel);
  if (!added &&
      (known->second.topic != channel.topic || known->second.schema_id != channel.schema_id)) {
    fail("channel " + std::to_string(channel.id) + " is declared twice: as " +
         excerpt(known->second.topic) + " and as " + excerpt(channel.topic));
  }
}

RecordedMessage Reader::message_of(std::string_view bytes) {
  Message message;
  if (!read_record(bytes, message)) fail("a message is damaged");
  const auto channel = channels_.find(message.channel_id);
  if (channel == channels_.end()) {
    fail("a message of channel " + std::to_string(message.channel_id) +
         ", which is not declared before it");
  }
  ++counts_[message.channel_id];
  const auto schema = schemas_.find(channel->second.schema_id);
  return {&channel->second,     schema == schemas_.end() ? nullptr : &schema->second,
          message.sequence,     message.log_time,
          message.publish_time, message.data.bytes};
}

void Reader::check_index(std::string_view bytes) const {
  MessageIndex index;
  if (!read_record(bytes, index)) fail("a message index is damaged");
  if (chunk_messages_.empty()) return;  // of a chunk that was passed over
  std::ranges::sort(index.records);
  const auto found = chunk_messages_.find(index.channel_id);
  auto there = found == chunk_messages_.end() ? decltype(index.records){} : found->second;
  std::ranges::sort(there);
  if (there != index.records) {
    fail("the index does not name the messages that are in the chunk before it");
  }
}

void Reader::check_data_end(std::string_view bytes) const {
  DataEnd end;
  if (!read_record(bytes, end)) fail("the end of the data is damaged");
  if (end.crc != 0 && crc_known_ && end.crc != crc_) {
    fail("the checksum of the data is wrong; the file is damaged or was changed");
  }
}

bool Reader::resume() {
  if (lost_ || complete_) return false;
  if (chunk_open_) {
    if (in_chunk_ < chunk_.size()) return true;
    chunk_open_ = false;
    return true;
  }
  crc_known_ = false;
  chunk_messages_.clear();
  if (offset_ > record_offset_) return true;  // the record was read, but its content is damaged
  try {
    const Prefix prefix = prefix_at(offset_);
    offset_ += prefix_size + prefix.length;
    return true;
  } catch (const ScanFileError&) {
    lost_ = true;
    return false;
  }
}

std::optional<Summary> Reader::summary() const {
  constexpr std::uint64_t footer_size = prefix_size + 20;
  const std::uint64_t tail = footer_size + magic.size();
  if (!file_.holds(0, magic.size() + tail)) return std::nullopt;
  const std::uint64_t footer_at = file_.size() - tail;
  std::string bytes;
  file_.read(footer_at, tail, bytes);
  if (!bytes.ends_with(magic) || static_cast<Op>(bytes[0]) != Op::footer) return std::nullopt;
  Footer footer;
  if (!read_record(std::string_view(bytes).substr(prefix_size, 20), footer)) return std::nullopt;
  if (footer.summary_start == 0) return std::nullopt;
  if (footer.summary_start > footer_at || footer_at - footer.summary_start > largest_chunk) {
    file_.fail(footer_at, "the summary is said to begin at byte " +
                              std::to_string(footer.summary_start) + ", which cannot be");
  }
  std::string records;
  file_.read(footer.summary_start, static_cast<std::size_t>(footer_at - footer.summary_start),
             records);
  const std::uint32_t crc =
      crc_of(std::string_view(bytes).substr(0, prefix_size + 16), crc_of(records));
  if (footer.summary_crc != 0 && crc != footer.summary_crc) {
    file_.fail(footer.summary_start, "the checksum of the summary is wrong; it is damaged");
  }
  Summary summary;
  std::string_view left(records);
  while (!left.empty()) {
    const std::uint64_t at = footer_at - left.size();
    std::uint64_t length = 0;
    if (left.size() >= prefix_size) std::memcpy(&length, left.data() + 1, sizeof length);
    if (left.size() < prefix_size || length > left.size() - prefix_size) {
      file_.fail(at, "a record of the summary goes beyond its end");
    }
    const auto op = static_cast<Op>(left[0]);
    const std::string_view fields = left.substr(prefix_size, length);
    const auto read = [&](auto record, auto use) {
      if (!read_record(fields, record)) {
        file_.fail(at, "a record of the summary (" + hexadecimal(static_cast<std::uint8_t>(op)) +
                           ") is damaged");
      }
      use(std::move(record));
    };
    switch (op) {
      case Op::schema:
        read(Schema{}, [&](Schema r) { summary.schemas[r.id] = std::move(r); });
        break;
      case Op::channel:
        read(Channel{}, [&](Channel r) { summary.channels[r.id] = std::move(r); });
        break;
      case Op::statistics:
        read(Statistics{}, [&](Statistics r) { summary.statistics = std::move(r); });
        break;
      case Op::chunk_index:
        read(ChunkIndex{}, [&](ChunkIndex r) { summary.chunks.push_back(std::move(r)); });
        break;
      case Op::attachment_index:
        read(AttachmentIndex{},
             [&](AttachmentIndex r) { summary.attachments.push_back(std::move(r)); });
        break;
      case Op::metadata_index:
        read(MetadataIndex{}, [&](MetadataIndex r) { summary.metadata.push_back(std::move(r)); });
        break;
      default:
        break;
    }
    left.remove_prefix(prefix_size + length);
  }
  return summary;
}

Metadata Reader::metadata_at(const MetadataIndex& index) const {
  const Prefix prefix = prefix_at(index.offset);
  Metadata metadata;
  std::string bytes;
  if (prefix.op == Op::metadata && prefix.length <= largest_record) {
    file_.read(index.offset + prefix_size, static_cast<std::size_t>(prefix.length), bytes);
    if (read_record(std::string_view(bytes), metadata)) return metadata;
  }
  file_.fail(index.offset, "the index names a metadata record that is not here");
}

std::string Reader::attachment_at(const AttachmentIndex& index) const {
  const Prefix prefix = prefix_at(index.offset);
  Attachment attachment;
  std::string bytes;
  if (prefix.op == Op::attachment && prefix.length <= largest_chunk) {
    file_.read(index.offset + prefix_size, static_cast<std::size_t>(prefix.length), bytes);
    if (read_record(std::string_view(bytes), attachment)) {
      const std::uint32_t crc =
          crc_of(std::string_view(bytes).substr(0, bytes.size() - sizeof attachment.crc));
      if (attachment.crc != 0 && attachment.crc != crc) {
        file_.fail(index.offset, "the checksum of an attachment is wrong; it is damaged");
      }
      return std::string(attachment.data.bytes);
    }
  }
  file_.fail(index.offset, "the index names an attachment that is not here");
}

}  // namespace quoin::sensor_bridge::mcap
