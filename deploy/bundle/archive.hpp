// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace quoin::deploy {

/// A file of an archive. Names have at most 99 bytes.
struct ArchivedFile {
  std::string name;
  std::string content;
};

/// The files as a compressed tar archive (POSIX ustar), which `tar xzf` unpacks; they belong to
/// nobody and are readable by their owner alone. Throws std::invalid_argument for a name that is
/// too long.
[[nodiscard]] std::string tar_gz(const std::vector<ArchivedFile>& files);

}  // namespace quoin::deploy
