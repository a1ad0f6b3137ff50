// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <sys/types.h>

namespace quoin {

/// Writes `content` beside `file`, with this mode whatever the umask is, brings it to the disk and
/// renames it: a power cut leaves the file as it was, or whole. Where it is not to `replace` one
/// that is there, that is EEXIST. Returns 0, or the error (errno); then nothing has changed.
[[nodiscard]] int write_atomically(const std::filesystem::path& file, std::string_view content,
                                   mode_t mode, bool replace = true);

}  // namespace quoin
