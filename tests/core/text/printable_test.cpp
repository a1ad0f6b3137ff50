// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/text/printable.hpp"

#include <gtest/gtest.h>

namespace quoin {
namespace {

TEST(Printable, LeavesTextAlone) {
  EXPECT_EQ(printable(""), "");
  EXPECT_EQ(printable("walls 1 ~"), "walls 1 ~");
  EXPECT_EQ(printable("l\xC3\xA4ser \xE2\x82\xAC \xF0\x9F\xA4\x96"),
            "l\xC3\xA4ser \xE2\x82\xAC \xF0\x9F\xA4\x96");
  EXPECT_EQ(printable("a\tb\nc", Lines::many), "a\tb\nc");
}

TEST(Printable, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(printable("\x1b[2J\x07"), "\\x1B[2J\\x07");
  EXPECT_EQ(printable("a\nb"), "a\\x0Ab");
  EXPECT_EQ(printable("a\rb", Lines::many), "a\\x0Db");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J"),
            "\\xC2\\x9B2J");  // a control sequence in one character
  EXPECT_EQ(printable("\xE2\x80\xAE"
                      "x"),
            "\\xE2\\x80\\xAEx");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xC3("), "\\xC3(");
  EXPECT_EQ(printable("\xC0\xAF"), "\\xC0\\xAF");           // longer than needed
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80");  // half of a surrogate
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");
  EXPECT_EQ(printable("\xE2\x82"), "\\xE2\\x82");  // cut off
}

TEST(Printable, ShortensBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", Lines::one, 6), "abcdef");
  EXPECT_EQ(printable("abcdefg", Lines::one, 6), "abcdef...");
  EXPECT_EQ(printable("ab\xE2\x82\xAC", Lines::one, 4), "ab...");
}

TEST(Printable, SaysWhatIs) {
  EXPECT_TRUE(is_printable("walls"));
  EXPECT_TRUE(is_printable(""));
  EXPECT_FALSE(is_printable("a\nb"));
  EXPECT_TRUE(is_printable("a\nb", Lines::many));
  EXPECT_FALSE(is_printable("\xFF", Lines::many));
}

}  // namespace
}  // namespace quoin
