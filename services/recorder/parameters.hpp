// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/message_files/compression.hpp"

namespace quoin {

/// In which encodings a recording has each message.
enum class RecordedContent {
  cdr,       ///< as it was sent, with its IDL: to be replayed bit for bit
  protobuf,  ///< for viewers
  both,
};

template <>
struct EnumNames<RecordedContent> {
  static constexpr std::array<std::pair<RecordedContent, std::string_view>, 3> names{
      {{RecordedContent::cdr, "cdr"},
       {RecordedContent::protobuf, "protobuf"},
       {RecordedContent::both, "both"}}};
};

/// Parameters of the recorder.
struct RecorderParameters {
  std::string path;
  RecordedContent content = RecordedContent::both;
  sensor_bridge::Compression compression = sensor_bridge::Compression::zstd;
  std::string split;
  double keep_free = 100.0;  ///< [MB]

  static constexpr auto fields() {
    using P = RecorderParameters;
    return std::tuple{
        required_field(&P::path, "path",
                       "file to write (.mcap), or a folder (ends with /) in which each run gets a "
                       "file of its own (relative to the deployment file)"),
        field(&P::content, "content",
              "messages as they were sent (cdr), for viewers (protobuf), or both"),
        field(&P::compression, "compression", "of the chunks of the file"),
        field(&P::split, "split",
              "begin a new file after so much: a time (10min, 1h) or a size (500MB, 1GB); empty "
              "is never"),
        field(&P::keep_free, "keep_free", "", 0.0, 1e9,
              "megabytes that are left to others: with less on the disk the recording stops")};
  }
};

}  // namespace quoin
