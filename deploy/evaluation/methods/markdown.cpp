// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/markdown.hpp"

#include <algorithm>
#include <sstream>

namespace quoin::deploy {

namespace {

constexpr std::size_t line_width = 100;

/// A bar would end the cell.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

}  // namespace

std::string markdown_paragraph(std::string_view text) {
  std::string result;
  std::size_t column = 0;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word; column += word.size()) {
    if (column > 0) {
      const bool fits = column + 1 + word.size() <= line_width;
      result += fits ? ' ' : '\n';
      column = fits ? column + 1 : 0;
    }
    result += word;
  }
  return result + "\n\n";
}

std::string markdown_table(std::vector<std::vector<std::string>> rows, std::size_t left) {
  constexpr std::size_t least_width = 3;  // of the rule below the head
  const std::size_t columns = rows.front().size();
  std::vector<std::size_t> widths(columns, least_width);
  for (auto& row : rows) {
    for (std::size_t i = 0; i < columns; ++i) {
      row[i] = escaped(row[i]);
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  if (left >= columns) widths.back() = std::max(least_width, rows.front().back().size());
  std::string text;
  const auto append = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::string padding(widths[i] - std::min(widths[i], row[i].size()), ' ');
      text += "| " + (i < left ? row[i] + padding : padding + row[i]) + " ";
    }
    text += "|\n";
  };
  append(rows.front());
  for (std::size_t i = 0; i < columns; ++i) {
    text += i < left ? "|" + std::string(widths[i] + 2, '-')
                     : "|" + std::string(widths[i] + 1, '-') + ":";
  }
  text += "|\n";
  std::for_each(rows.begin() + 1, rows.end(), append);
  return text + "\n";
}

}  // namespace quoin::deploy
