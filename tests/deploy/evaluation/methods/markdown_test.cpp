// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/markdown.hpp"

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>

namespace quoin::deploy {
namespace {

TEST(Markdown, ParagraphsAreWrappedBetweenWords) {
  EXPECT_EQ(markdown_paragraph("one two"), "one two\n\n");
  std::string text;
  for (int i = 0; i < 50; ++i) text += "word" + std::to_string(i) + " ";
  const std::string wrapped = markdown_paragraph(text);
  std::istringstream lines(wrapped);
  std::string joined;
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    longest = std::max(longest, line.size());
    joined += line + " ";
  }
  EXPECT_EQ(joined, text);
  EXPECT_LE(longest, 100U);
  EXPECT_GT(longest, 92U);  // no word is longer than 6, so that none more would have fitted
  EXPECT_EQ(markdown_paragraph(std::string(150, 'x') + " y"), std::string(150, 'x') + "\ny\n\n");
}

TEST(Markdown, TablesReadAsTablesInTheSourceToo) {
  EXPECT_EQ(markdown_table({{"name", "value"}, {"a", "1.5"}, {"longer", "-"}}, 1),
            "| name   | value |\n"
            "|--------|------:|\n"
            "| a      |   1.5 |\n"
            "| longer |     - |\n\n");
}

TEST(Markdown, TheLastColumnOfTextIsNotPadded) {
  EXPECT_EQ(markdown_table({{"a", "meaning"}, {"b", "a long story"}}, 2),
            "| a   | meaning |\n"
            "|-----|---------|\n"
            "| b   | a long story |\n\n");
}

TEST(Markdown, BarsDoNotEndACell) {
  EXPECT_EQ(markdown_table({{"x|y"}}, 1), "| x\\|y |\n|------|\n\n");
}

}  // namespace
}  // namespace quoin::deploy
