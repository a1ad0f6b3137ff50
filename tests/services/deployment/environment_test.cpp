// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/environment.hpp"

#include <stdexcept>

#include <gmock/gmock.h>

namespace quoin {
namespace {

std::optional<std::string> lookup(const std::string& name) {
  if (name == "HOME_DIR") return "/home/robot";
  if (name == "EMPTY") return "";
  if (name == "NESTED") return "${HOME_DIR}";
  return std::nullopt;
}

std::string replaced(const std::string& text) { return replace_variables(text, lookup); }

TEST(Environment, LeavesTextWithoutVariablesAlone) {
  EXPECT_EQ(replaced(""), "");
  EXPECT_EQ(replaced("10 $ } {x} $HOME_DIR"), "10 $ } {x} $HOME_DIR");
}

TEST(Environment, ReplacesVariables) {
  EXPECT_EQ(replaced("${HOME_DIR}/a"), "/home/robot/a");
  EXPECT_EQ(replaced("a${HOME_DIR}${HOME_DIR}"), "a/home/robot/home/robot");
  EXPECT_EQ(replaced("[${EMPTY}]"), "[]");
}

TEST(Environment, UsesTheDefaultForUnsetAndEmptyVariables) {
  EXPECT_EQ(replaced("${UNSET:-../data}/x"), "../data/x");
  EXPECT_EQ(replaced("${EMPTY:-d}"), "d");
  EXPECT_EQ(replaced("${HOME_DIR:-d}"), "/home/robot");
  EXPECT_EQ(replaced("${UNSET:-}"), "");
  EXPECT_EQ(replaced("${UNSET:-a:-b}"), "a:-b");
}

TEST(Environment, ADefaultMayHaveVariables) {
  EXPECT_EQ(replaced("${UNSET:-${HOME_DIR}}/x"), "/home/robot/x");
  EXPECT_EQ(replaced("${UNSET:-a${EMPTY:-${HOME_DIR}}b}}"), "a/home/robotb}");
  EXPECT_THROW((void)replaced("${UNSET:-${HOME_DIR}"), std::invalid_argument);
  EXPECT_THROW((void)replaced("${UNSET:-${UNSET}}"), std::invalid_argument);
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "${UNSET:-";
  EXPECT_THROW((void)replaced(deep + std::string(100, '}')), std::invalid_argument);
}

TEST(Environment, ValuesDoNotGrowWithoutBound) {
  std::string text;
  for (int i = 0; i < 60'000; ++i) text += "${HOME_DIR}";
  EXPECT_THROW((void)replaced(text), std::invalid_argument);
}

TEST(Environment, DoesNotReplaceInsideValues) { EXPECT_EQ(replaced("${NESTED}"), "${HOME_DIR}"); }

TEST(Environment, RejectsWhatItCannotReplace) {
  EXPECT_THROW((void)replaced("${UNSET}"), std::invalid_argument);
  EXPECT_THROW((void)replaced("${HOME_DIR"), std::invalid_argument);
  EXPECT_THROW((void)replaced("${}"), std::invalid_argument);
  EXPECT_THROW((void)replaced("${:-x}"), std::invalid_argument);
  EXPECT_THROW((void)replaced("${A B}"), std::invalid_argument);
  EXPECT_THROW((void)replaced("${1A}"), std::invalid_argument);
}

}  // namespace
}  // namespace quoin
