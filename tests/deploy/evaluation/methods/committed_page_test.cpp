// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// docs/methods.md is written by the program; its first lines say how. Figures differ from machine
// to machine, but everything else must be what the program would write today.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>

#include "deploy/evaluation/methods/methods_page.hpp"
#include "deploy/kinds/kinds.hpp"

namespace quoin::deploy {
namespace {

std::string committed_page() {
  std::ifstream file(QUOIN_METHODS_PAGE, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What is between empty lines.
std::vector<std::string> blocks(const std::string& page) {
  std::vector<std::string> blocks(1);
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) {
      blocks.back() += line + "\n";
    } else if (!blocks.back().empty()) {
      blocks.emplace_back();
    }
  }
  return blocks;
}

/// Without those of figures.
std::vector<std::string> headings(const std::string& page) {
  std::vector<std::string> headings;
  for (const std::string& block : blocks(page)) {
    if (block.starts_with('#') && !block.starts_with("### Figures of ")) headings.push_back(block);
  }
  return headings;
}

TEST(CommittedMethodsPage, TellsWhatTheRegistryTells) {
  const std::string committed = committed_page();
  ASSERT_FALSE(committed.empty()) << QUOIN_METHODS_PAGE;
  const std::vector<std::string> expected = blocks(methods_page(kinds().kinds, nullptr));
  const std::vector<std::string> found = blocks(committed);
  // In order, with figures between them.
  auto next = found.begin();
  for (const std::string& block : expected) {
    const auto match = std::find(next, found.end(), block);
    ASSERT_NE(match, found.end()) << "docs/methods.md lacks or misplaces this block; its first "
                                     "lines say how to write it anew:\n"
                                  << block;
    next = match + 1;
  }
}

TEST(CommittedMethodsPage, HasNoMethodThatIsNotInTheRegistry) {
  EXPECT_EQ(headings(committed_page()), headings(methods_page(kinds().kinds, nullptr)));
}

}  // namespace
}  // namespace quoin::deploy
