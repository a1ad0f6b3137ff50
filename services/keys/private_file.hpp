// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>

namespace quoin {

constexpr mode_t mode_private = 0600;  ///< for the owner alone
constexpr mode_t mode_public = 0644;

/// Makes the folder and those above it, for the owner alone, unless they are there.
void make_private_folder(const std::filesystem::path& folder);

/// Writes the file in one step: a reader sees all of the old or all of the new. Without `replace` a
/// file that is there is an error. Throws std::runtime_error.
void write_file(const std::filesystem::path& file, const std::string& text, mode_t mode,
                bool replace);

/// Throws std::runtime_error "FILE: reason". Files of more than a megabyte are refused.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace quoin
