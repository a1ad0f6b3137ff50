// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/mapping/line_map.hpp"

namespace quoin::maps {

/// A map that cannot be read or written: "file:line: what; what to do".
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Larger files are no maps of a building, and are not read.
inline constexpr std::size_t largest_file = 256U << 20U;  // [byte]
inline constexpr std::size_t most_lines = 1'000'000;

/// The text of a file. Throws MapError when it cannot be read or is larger than `largest_file`.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Writes beside the file and renames: it is there whole or as it was. Throws MapError.
void write_whole(const std::filesystem::path& file, std::string_view content);

/// A map of kind mapping, with what its method needs to go on.
struct SavedMap {
  std::string frame = "map";
  std::uint64_t begun = 0;  ///< [ns since the Unix epoch] when the map was
  std::string method;       ///< that made it; "" of no method
  std::string state_form;   ///< of its state, MethodInfo::state
  std::vector<std::uint8_t> state;
  std::vector<MapLine> lines;
};

/// The format of .qmap files: text with a version, and a checksum (CRC-32) at its end.
[[nodiscard]] std::string map_text(const SavedMap& map);
/// `file` is what messages name. Throws MapError for text that is damaged, of a later version or
/// something else.
[[nodiscard]] SavedMap parse_map(std::string_view text, const std::string& file);

}  // namespace quoin::maps
