// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/process/log.hpp"

namespace quoin::runtime {
namespace {

using std::chrono::milliseconds;
using testing::EndsWith;
using testing::HasSubstr;

class LogLimitTest : public testing::Test {
 protected:
  std::string line(const std::string& message) { return limit_.line(message).value_or(""); }
  LogLimit::Clock::time_point now_ = LogLimit::Clock::now();
  LogLimit limit_{[this] { return now_; }};
};

TEST_F(LogLimitTest, OfWhatRepeatsItselfTheFirstAreWrittenAndThenCounts) {
  int written = 0;
  for (int i = 0; i < 10'000; ++i) {
    if (!line(std::to_string(i) + " scans lost by the link").empty()) ++written;
    now_ += milliseconds(1);
  }
  EXPECT_EQ(written, 10);
  now_ += std::chrono::seconds(10);
  EXPECT_THAT(line("7 scans lost by the link"), EndsWith("(and 9990 like it before)"));
  EXPECT_EQ(line("8 scans lost by the link"), "");
  EXPECT_EQ(line("something else"), "something else");
}

TEST_F(LogLimitTest, ADayOfAttackStaysShort) {
  std::size_t bytes = 0;
  for (std::uint64_t i = 0; i < 86'400; ++i) {
    // Names that a stranger invents, without digits.
    std::string name(2000, 'x');
    for (std::size_t k = 0; k < 5; ++k) name[k] = static_cast<char>('a' + (i >> (4 * k)) % 16);
    bytes += line("3 scans of 0..2 lost by " + name).size();
    now_ += std::chrono::seconds(1);
  }
  EXPECT_LT(bytes, 10'000'000U);
  EXPECT_GT(bytes, 1'000'000U);  // it says all day that something happens
}

TEST_F(LogLimitTest, WhatWasLeftOutForWantOfRoomIsCounted) {
  for (int i = 0; i < 1000; ++i) line("lost by " + std::string(static_cast<std::size_t>(i), 'x'));
  now_ += std::chrono::seconds(10);
  EXPECT_THAT(line("done"), HasSubstr("others were too many"));
}

TEST_F(LogLimitTest, LinesArePrintableAndOne) {
  EXPECT_EQ(line("walls\nerror: forged\x1b[2J"), "walls\\x0Aerror: forged\\x1B[2J");
  EXPECT_LT(line(std::string(100'000, 'y')).size(), 1100U);
}

}  // namespace
}  // namespace quoin::runtime
