// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/systemd_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "core/text/printable.hpp"

namespace quoin::deploy {

namespace {

bool is_control(char character) {
  return static_cast<unsigned char>(character) < ' ' || character == 127;
}

std::string hexadecimal(char character) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "\\x%02x", static_cast<unsigned char>(character));
  return text.data();
}

std::string word(std::string_view text, bool double_dollars) {
  constexpr std::string_view plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=:,./@%$";
  std::string inner;
  for (const char character : text) {
    if (is_control(character)) {
      inner += hexadecimal(character);
      continue;
    }
    if (character == '\\' || character == '"') inner += '\\';
    if (character == '%' || (character == '$' && double_dollars)) inner += character;
    inner += character;
  }
  const bool quoted = text.empty() || text.find_first_not_of(plain) != std::string_view::npos;
  return quoted ? "\"" + inner + "\"" : inner;
}

}  // namespace

std::string unit_word(std::string_view text) { return word(text, false); }

std::string unit_argument(std::string_view text) { return word(text, true); }

std::string unit_program(std::string_view path) {
  if (std::ranges::any_of(path, is_control) ||
      path.find_first_of("\"'\\") != std::string_view::npos) {
    throw std::invalid_argument(
        "systemd starts no program with quotes, backslashes or control "
        "characters in its path: " +
        unit_comment(path));
  }
  return word(path, false);
}

std::string unit_comment(std::string_view text) {
  std::string line = printable(text);
  // A backslash at the end of a line would join the next to it.
  if (line.ends_with('\\')) line += ' ';
  return line;
}

}  // namespace quoin::deploy
