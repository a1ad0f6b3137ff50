// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quoin::deploy {

/// A table whose first `text_columns` columns are aligned to the left.
struct HtmlTable {
  std::vector<std::pair<std::string, std::size_t>> groups;  ///< heads over several columns, or none
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::size_t text_columns = 1;
  bool last_row_is_summary = false;
};

/// Writes a page that needs no other file and no network. All text is escaped.
class HtmlPage {
 public:
  HtmlPage(std::string_view title, std::string_view subtitle);

  /// Level 2 headings also go into the table of contents.
  void heading(int level, std::string_view text);
  void paragraph(std::string_view text);
  void table(const HtmlTable& table);
  /// `svg` is the text of an SVG file; its declaration is dropped.
  void figure(std::string_view svg, std::string_view caption);

  /// Ends the page and returns it.
  [[nodiscard]] std::string finish();

 private:
  std::string head_;
  std::string contents_;
  std::string body_;
  std::size_t headings_ = 0;
};

}  // namespace quoin::deploy
