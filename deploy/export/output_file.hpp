// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace quoin::deploy {

/// First line of what is exported; a file that begins with it may be replaced.
inline constexpr const char* export_marker =
    "# Written by quoin export, which replaces this file when it is run again.";

/// Whether `file` is not there, or was written by an export before.
[[nodiscard]] bool may_replace(const std::filesystem::path& file);

/// Writes `text` to `file`, whole or not at all, for everybody to read; a pipe or device as
/// it is. Throws std::runtime_error.
void write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace quoin::deploy
