// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace quoin::sensor_bridge {

/// The text with '?' for bytes that are not printable ASCII: it comes of a file or the network, and
/// goes to logs and terminals.
[[nodiscard]] inline std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text) result += c >= ' ' && c <= '~' ? c : '?';
  return result;
}

/// A piece of an input file for a message: in quotes, shortened and printable.
[[nodiscard]] inline std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "'" + printable(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

}  // namespace quoin::sensor_bridge
