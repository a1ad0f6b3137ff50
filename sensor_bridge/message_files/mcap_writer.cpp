// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/mcap_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "sensor_bridge/message_files/mcap_codec.hpp"

namespace quoin::sensor_bridge::mcap {

namespace {

bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

template <class Record>
void append_group(const std::vector<Record>& records, std::uint64_t summary_start, std::string& out,
                  std::string& offsets) {
  if (records.empty()) return;
  const std::size_t begin = out.size();
  for (const Record& record : records) append_record(record, out);
  append_record(SummaryOffset{static_cast<std::uint8_t>(Record::op), summary_start + begin,
                              out.size() - begin},
                offsets);
}

}  // namespace

Writer::Writer(const std::filesystem::path& path, WriterOptions options)
    : path_(path), part_(path.string() + ".part"), options_(std::move(options)) {
  if (is_there(path_)) fail("is there already", 0);
  descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0640);
  if (descriptor_ < 0) {
    if (errno == EEXIST) {
      throw WriteError("'" + part_.string() +
                       "' is left of a recording that did not end well; see what is in it with "
                       "'quoin recording recover', or remove it");
    }
    fail("cannot be written", errno);
  }
  record_ = magic;
  append_record(Header{options_.profile, options_.library}, record_);
  append(record_);
}

Writer::~Writer() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint16_t Writer::add_schema(const std::string& name, const std::string& encoding,
                                 const std::string& data) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  Schema schema{id, name, encoding, data};
  record_.clear();
  append_record(schema, record_);
  append(record_);
  schemas_.push_back(std::move(schema));
  return id;
}

std::uint16_t Writer::add_channel(std::uint16_t schema, const std::string& topic,
                                  const std::string& encoding, const Text& metadata) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  Channel channel{id, schema, topic, encoding, metadata};
  record_.clear();
  append_record(channel, record_);
  append(record_);
  channels_.push_back(std::move(channel));
  return id;
}

void Writer::add_metadata(const std::string& name, const Text& entries) {
  record_.clear();
  const std::uint64_t offset = offset_;
  const std::size_t length = append_record(Metadata{name, entries}, record_);
  append(record_);
  metadata_.push_back({offset, length, name});
}

void Writer::add_attachment(const std::string& name, const std::string& media_type,
                            std::string_view data, std::uint64_t time) {
  record_.clear();
  const std::uint64_t offset = offset_;
  const std::size_t length =
      append_record(Attachment{time, time, name, media_type, {data}, 0}, record_);
  const std::string_view fields = std::string_view(record_).substr(prefix_size);
  const std::uint32_t crc = crc_of(fields.substr(0, fields.size() - sizeof(std::uint32_t)));
  std::memcpy(record_.data() + record_.size() - sizeof crc, &crc, sizeof crc);
  append(record_);
  attachments_.push_back({offset, length, time, time, data.size(), name, media_type});
}

void Writer::write(const Message& message) {
  if (chunk_.empty()) {
    start_ = std::numeric_limits<std::uint64_t>::max();
    end_ = 0;
  }
  MessageIndex& index = index_[message.channel_id];
  index.channel_id = message.channel_id;
  index.records.emplace_back(message.log_time, chunk_.size());
  append_record(message, chunk_);
  start_ = std::min(start_, message.log_time);
  end_ = std::max(end_, message.log_time);
  ++messages_;
  if (chunk_.size() >= options_.chunk_size) flush();
}

void Writer::flush() {
  if (chunk_.empty()) return;
  WrittenChunk written;
  written.crc_before = crc_;
  compress(options_.compression, chunk_, compressed_);
  const std::string compression(compression_name(options_.compression));
  record_.clear();
  const std::size_t length = append_record(
      Chunk{start_, end_, chunk_.size(), crc_of(chunk_), compression, {compressed_}}, record_);
  written.index = {start_,       end_, offset_, length, {}, 0, compression, compressed_.size(),
                   chunk_.size()};
  for (const auto& [channel, index] : index_) {
    if (index.records.empty()) continue;
    written.messages[channel] = index.records.size();
    written.index.index_offsets[channel] = offset_ + record_.size();
    append_record(index, record_);
  }
  written.index.index_length = record_.size() - length;
  std::uint64_t count = 0;
  for (auto& [channel, index] : index_) {
    count += index.records.size();
    index.records.clear();
  }
  chunk_.clear();
  try {
    append(record_);
  } catch (const WriteError&) {
    messages_ -= count;
    dropped_ += count;
    throw;
  }
  chunks_.push_back(std::move(written));
}

void Writer::drop_last_chunk() {
  const WrittenChunk& last = chunks_.back();
  for (const auto& [channel, count] : last.messages) {
    messages_ -= count;
    dropped_ += count;
  }
  const std::uint64_t offset = last.index.chunk_offset;
  const std::uint32_t crc = last.crc_before;
  // What was written behind it goes, too.
  std::erase_if(metadata_, [&](const MetadataIndex& index) { return index.offset >= offset; });
  std::erase_if(attachments_, [&](const AttachmentIndex& index) { return index.offset >= offset; });
  truncate(offset, crc);
  chunks_.pop_back();
}

std::string Writer::summary() const {
  Statistics statistics;
  statistics.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics.channels = static_cast<std::uint32_t>(channels_.size());
  statistics.attachments = static_cast<std::uint32_t>(attachments_.size());
  statistics.metadata = static_cast<std::uint32_t>(metadata_.size());
  statistics.chunks = static_cast<std::uint32_t>(chunks_.size());
  std::vector<ChunkIndex> indexes;
  indexes.reserve(chunks_.size());
  for (const WrittenChunk& chunk : chunks_) {
    for (const auto& [channel, count] : chunk.messages) {
      statistics.channel_messages[channel] += count;
      statistics.messages += count;
    }
    statistics.start =
        indexes.empty() ? chunk.index.start : std::min(statistics.start, chunk.index.start);
    statistics.end = std::max(statistics.end, chunk.index.end);
    indexes.push_back(chunk.index);
  }

  std::string out;
  append_record(DataEnd{crc_}, out);
  const std::size_t begin = out.size();
  const std::uint64_t start = offset_ + begin;
  std::string groups;
  std::string offsets;
  append_group(schemas_, start, groups, offsets);
  append_group(channels_, start, groups, offsets);
  append_group(std::vector{statistics}, start, groups, offsets);
  append_group(indexes, start, groups, offsets);
  append_group(attachments_, start, groups, offsets);
  append_group(metadata_, start, groups, offsets);
  out += groups;
  const std::uint64_t offsets_start = offset_ + out.size();
  out += offsets;
  append_record(Footer{start, offsets_start, 0}, out);
  const std::size_t crc_at = out.size() - sizeof(std::uint32_t);
  const std::uint32_t crc = crc_of(std::string_view(out).substr(begin, crc_at - begin));
  std::memcpy(out.data() + crc_at, &crc, sizeof crc);
  out += magic;
  return out;
}

void Writer::finish() {
  try {
    flush();
  } catch (const WriteError&) {
    // Counted as dropped; the file is closed without that chunk.
  }
  while (true) {
    try {
      append(summary());
      break;
    } catch (const WriteError&) {
      if (chunks_.empty()) throw;
      drop_last_chunk();
    }
  }
  const bool synced = ::fsync(descriptor_) == 0;
  const int error = errno;
  ::close(std::exchange(descriptor_, -1));
  if (!synced) fail("cannot be written", error);
  // link() replaces nothing; where the file system knows no links, rename() does what it can.
  if (::link(part_.c_str(), path_.c_str()) == 0) {
    ::unlink(part_.c_str());
  } else if (errno == EEXIST) {
    throw WriteError("'" + path_.string() + "' has appeared meanwhile; the recording is in '" +
                     part_.string() + "'");
  } else if (::rename(part_.c_str(), path_.c_str()) != 0) {
    fail("cannot get its name", errno);
  }
}

void Writer::append(std::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int error = count < 0 ? errno : ENOSPC;
      truncate(offset_, crc_);
      fail("cannot be written", error);
    }
    done += static_cast<std::size_t>(count);
  }
  crc_ = crc_of(bytes, crc_);
  offset_ += bytes.size();
}

void Writer::truncate(std::uint64_t offset, std::uint32_t crc) {
  if (::ftruncate(descriptor_, static_cast<off_t>(offset)) != 0 ||
      ::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0) {
    fail("cannot be cut back", errno);
  }
  offset_ = offset;
  crc_ = crc;
}

void Writer::fail(const std::string& what, int error) const {
  throw WriteError("'" + path_.string() + "' " + what +
                   (error == 0 ? "" : ": " + std::generic_category().message(error)));
}

}  // namespace quoin::sensor_bridge::mcap
