// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "core/parameters/parameter.hpp"

namespace quoin::sensor_bridge {

/// How the chunks of a recording are compressed.
enum class Compression {
  none,
  zstd,
  lz4,  ///< LZ4 frames
  bz2   ///< only read: ROS 1
};

/// Why bytes cannot be decompressed.
class CompressionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// By its name in a recording; "" is none. Nothing for one that is not known here.
[[nodiscard]] std::optional<Compression> compression_of(std::string_view name);
/// Its name in an MCAP file.
[[nodiscard]] std::string_view compression_name(Compression compression);

/// [byte] No chunk of any recording needs more; a file that says so is damaged, or made to fill the
/// memory.
inline constexpr std::size_t largest_chunk = std::size_t{256} << 20U;

/// Replaces `out`. Not for bz2.
void compress(Compression compression, std::string_view bytes, std::string& out);

/// Replaces `out` by `size` bytes, as the recording promises them. Throws CompressionError when
/// there are more or fewer, or `size` is above largest_chunk; memory is only taken for what is
/// there.
void decompress(Compression compression, std::string_view bytes, std::size_t size,
                std::string& out);

}  // namespace quoin::sensor_bridge

namespace quoin {

/// Those that a recorder can choose.
template <>
struct EnumNames<sensor_bridge::Compression> {
  static constexpr std::array<std::pair<sensor_bridge::Compression, std::string_view>, 3> names{
      {{sensor_bridge::Compression::none, "none"},
       {sensor_bridge::Compression::zstd, "zstd"},
       {sensor_bridge::Compression::lz4, "lz4"}}};
};

}  // namespace quoin
