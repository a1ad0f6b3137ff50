// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace quoin::sensor_bridge {

/// A piece of an input file for a message: in quotes, shortened, and with '?' for bytes that are
/// not printable ASCII, because its content is unknown and goes to logs and terminals.
[[nodiscard]] inline std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "'";
  for (const char c : text.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
  result += text.size() > longest ? "...'" : "'";
  return result;
}

}  // namespace quoin::sensor_bridge
