// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/line_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>
#include <unistd.h>

#include <zlib.h>

#include "services/files/regular_file.hpp"

namespace quoin::sensor_bridge {
namespace {

gzFile file_of(void* handle) { return static_cast<gzFile>(handle); }

// zlib drops what it has decompressed of a block that turns out to be damaged; small blocks keep
// the good scans before the damage.
constexpr std::size_t chunk_size = 4096;  // [byte]

}  // namespace

void LineReader::Closer::operator()(void* handle) const { gzclose(file_of(handle)); }

LineReader::LineReader(const std::filesystem::path& file)
    : file_(file.string()), chunk_(chunk_size) {
  const RegularFile opened = open_regular(file);
  if (opened.descriptor < 0) {
    throw ScanFileError("cannot read scan file '" + file_ + "': " + opened.problem);
  }
  handle_.reset(gzdopen(opened.descriptor, "rb"));
  if (!handle_) {
    ::close(opened.descriptor);
    throw std::bad_alloc();
  }
  gzbuffer(file_of(handle_.get()), chunk_size);
  std::error_code error;
  size_ = std::filesystem::file_size(file, error);
  if (error) size_ = 0;  // gone meanwhile
}

double LineReader::progress() const {
  const auto read = static_cast<double>(gzoffset(file_of(handle_.get())));
  return size_ == 0 ? 0.0 : std::clamp(read / static_cast<double>(size_), 0.0, 1.0);
}

bool LineReader::next(std::string_view& line) {
  line_.clear();
  ++line_number_;
  bool whole = false;
  while (!whole) {
    if (begin_ == end_ && !fill()) {
      if (line_.empty()) {
        --line_number_;
        return false;
      }
      line = line_;
      break;
    }
    const char* first = chunk_.data() + begin_;
    const char* last = chunk_.data() + end_;
    const char* feed = std::find(first, last, '\n');
    whole = feed != last;
    const std::string_view part(first, static_cast<std::size_t>(feed - first));
    begin_ += part.size() + (whole ? 1 : 0);
    if (whole && line_.empty()) {
      line = part;
    } else {
      line_ += part;
      line = line_;
    }
    if (line_.size() > max_line_length)
      fail(max_line_length, "line longer than 16 MiB; is this a scan file?");
  }
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line_number_ > 1 && line.starts_with('\r')) line.remove_prefix(1);  // an end of LF CR
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (line_number_ == 1 && line.starts_with(byte_order_mark)) {
    line.remove_prefix(byte_order_mark.size());
  }
  return true;
}

bool LineReader::fill() {
  const int count =
      gzread(file_of(handle_.get()), chunk_.data(), static_cast<unsigned>(chunk_size));
  begin_ = 0;
  end_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  if (count > 0) return true;
  int code = Z_OK;
  std::string_view reason = gzerror(file_of(handle_.get()), &code);
  switch (code) {
    case Z_OK:
    case Z_STREAM_END:
      return false;
    case Z_BUF_ERROR:
      fail(line_.size(), "the compressed file ends in the middle; it was cut off, copy it again");
    case Z_ERRNO:
      fail(line_.size(), "cannot read on: " + std::generic_category().message(errno));
    default:
      // zlib puts what it takes for the path before the reason: "<fd:3>: ".
      if (reason.starts_with("<fd:")) reason.remove_prefix(reason.find(": ") + 2);
      fail(line_.size(),
           "the compressed file is damaged here (" + std::string(reason) + "); copy it again");
  }
}

void LineReader::fail(std::size_t offset, const std::string& what) const {
  throw ScanFileError(file_ + ":" + std::to_string(std::max<std::size_t>(line_number_, 1)) + ":" +
                      std::to_string(offset + 1) + ": " + what);
}

}  // namespace quoin::sensor_bridge
