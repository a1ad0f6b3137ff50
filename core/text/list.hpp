// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace quoin {

/// The entries of a list with commas, without blanks around them; empty ones are left out.
[[nodiscard]] inline std::vector<std::string> list_entries(std::string_view text) {
  std::vector<std::string> entries;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::size_t first = text.find_first_not_of(' ', begin);
    if (first < end) {
      const std::size_t last = text.find_last_not_of(' ', end - 1);
      entries.emplace_back(text.substr(first, last - first + 1));
    }
    begin = end + 1;
  }
  return entries;
}

}  // namespace quoin
