// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace quoin {

/// A character of UTF-8 text.
struct Utf8Character {
  char32_t code = 0;     ///< of Unicode
  std::size_t size = 0;  ///< [byte]; 0 where no valid character begins
};

/// The first character of a text that is not empty. Shorter forms than needed, surrogates and
/// numbers beyond Unicode are not valid (RFC 3629).
[[nodiscard]] inline Utf8Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || size > text.size()) return {};
  char32_t code = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
  if (code < smallest[size] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
  return {code, size};
}

/// Whether a terminal shows the character and nothing else happens: controls, which begin escape
/// sequences or a new line, and marks that turn the direction of the text round are not.
[[nodiscard]] constexpr bool is_printable(char32_t code) {
  const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool line_break = code == 0x2028 || code == 0x2029;
  const bool direction = code == 0x61C || code == 0x200E || code == 0x200F ||
                         (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return !control && !line_break && !direction && code != 0xFEFF;
}

enum class Lines {
  one,   ///< no line breaks
  many,  ///< '\n' and '\t' are allowed
};

/// Whether a text is valid UTF-8 of printable characters.
[[nodiscard]] inline bool is_printable(std::string_view text, Lines lines = Lines::one) {
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    const bool layout = character.code == U'\n' || character.code == U'\t';
    if (character.size == 0) return false;
    if (!is_printable(character.code) && !(layout && lines == Lines::many)) return false;
    text.remove_prefix(character.size);
  }
  return true;
}

/// Text of whoever may have written it, for a log or a terminal: each byte that is not part of a
/// printable character becomes \xNN. Of more than `longest` bytes the rest is left out and "..."
/// says so. All foreign text that goes to a log or a terminal passes here.
[[nodiscard]] inline std::string printable(std::string_view text, Lines lines = Lines::one,
                                           std::size_t longest = std::string_view::npos) {
  std::string result;
  std::size_t used = 0;
  while (used < text.size()) {
    const Utf8Character character = first_character(text.substr(used));
    const std::size_t size = character.size == 0 ? 1 : character.size;
    if (used + size > longest) return result + "...";
    const bool layout = character.code == U'\n' || character.code == U'\t';
    const bool shown =
        character.size > 0 && (is_printable(character.code) || (layout && lines == Lines::many));
    for (std::size_t i = used; i < used + size; ++i) {
      if (shown) {
        result += text[i];
      } else {
        std::array<char, 8> escaped{};
        std::snprintf(escaped.data(), escaped.size(), "\\x%02X",
                      static_cast<unsigned>(static_cast<unsigned char>(text[i])));
        result += escaped.data();
      }
    }
    used += size;
  }
  return result;
}

}  // namespace quoin
