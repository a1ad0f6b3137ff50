// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/process_writers.hpp"

#include <gtest/gtest.h>

namespace quoin::runtime {
namespace {

using std::chrono::milliseconds;

class ProcessWritersTest : public testing::Test {
 protected:
  bool admit(std::uint64_t incarnation, std::uint64_t writer,
             const std::string& service = "front") {
    return writers_.admit(service, incarnation, writer);
  }
  ProcessWriters::Clock::time_point now_{};
  ProcessWriters writers_{[this] { return now_; }};
};

TEST_F(ProcessWritersTest, NobodyElseSpeaksForAProcess) {
  EXPECT_TRUE(admit(1, 10));
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(admit(1, 66));
    now_ += milliseconds(100);
    EXPECT_TRUE(admit(1, 10));
  }
}

TEST_F(ProcessWritersTest, EachProcessHasItsOwn) {
  EXPECT_TRUE(admit(1, 10));
  EXPECT_TRUE(admit(2, 20));
  EXPECT_TRUE(admit(1, 30, "back"));
  EXPECT_TRUE(admit(1, 10));
  EXPECT_TRUE(admit(2, 20));
}

TEST_F(ProcessWritersTest, WhoHasBeenSilentIsFollowedByWhoIsNot) {
  EXPECT_TRUE(admit(1, 66));  // was there first
  EXPECT_FALSE(admit(1, 10));
  now_ += milliseconds(2100);
  EXPECT_TRUE(admit(1, 10));
  EXPECT_FALSE(admit(1, 66));
}

TEST_F(ProcessWritersTest, WhoAnnouncesItselfIsHeardAloneWhileItLives) {
  EXPECT_TRUE(writers_.admit("front", 7, 66));
  EXPECT_TRUE(writers_.admit("front", 1, 10, 1));
  EXPECT_FALSE(writers_.admit("front", 7, 66));
  EXPECT_FALSE(writers_.admit("front", 1, 66));
  EXPECT_FALSE(writers_.admit("front", 2, 10, 1));  // not even itself for another process
  // Another process of the service takes over, and a stranger does when nobody is left.
  EXPECT_TRUE(writers_.admit("front", 2, 20, 2));
  now_ += milliseconds(2100);
  EXPECT_TRUE(writers_.admit("front", 7, 66));
}

TEST_F(ProcessWritersTest, AnAnnouncementIsReadAsItWasWritten) {
  EXPECT_EQ(announced_incarnation(writer_announcement(1'700'000'000'000'000'000)),
            1'700'000'000'000'000'000U);
  EXPECT_EQ(announced_incarnation(writer_announcement(5) + "quoin type 0123abcd;"), 5U);
  for (const char* other : {"", "quoin process ", "quoin process x;", "quoin process 1 ;",
                            "quoin process 1", "typehash=1"}) {
    EXPECT_EQ(announced_incarnation(other), 0U) << other;
  }
}

TEST_F(ProcessWritersTest, WhoInventsProcessesMakesNobodyForgetThoseOfOthers) {
  EXPECT_TRUE(admit(1, 10));
  for (std::uint64_t i = 2; i < 10'000; ++i) EXPECT_TRUE(admit(i, 66));
  EXPECT_FALSE(admit(1, 66));
  EXPECT_TRUE(admit(1, 10));
}

}  // namespace
}  // namespace quoin::runtime
