// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace quoin::deploy {

/// `text` as lines of at most 100 characters, unless a word is longer, and an empty line.
[[nodiscard]] std::string markdown_paragraph(std::string_view text);

/// A table and an empty line. Columns are as wide as their widest cell, so that the source reads as
/// a table, too, but for the last of a table of text, which may be long. The first row is the head,
/// the first `left` columns are aligned to the left; all rows have as many cells as the first.
[[nodiscard]] std::string markdown_table(std::vector<std::vector<std::string>> rows,
                                         std::size_t left);

}  // namespace quoin::deploy
